#pragma once

#include "analyse/PicturesSoFar.h"
#include "analyse/events.h"
#include "base/RunContext.h"
#include "calibrate/calibrate.h"
#include "plan/Analysis.h"

#include <functional>
#include <memory>
#include <span>

namespace faintline {

/// Called for each block of frames of the statistic, in order: first frame, frames × cells values.
using StatisticSink = std::function<void(Index firstFrame, std::span<const float> statistic)>;

/// Scope of an analysis: everything; its tracks, without pictures and checkpoints; or a trial of its settings, whose
/// tracks are also not tested against the recording's own noise (ownNoiseLaw.h), which is not searched for signals
/// behind others (secondLook.h), and whose tracks are not trimmed to their signals (trimEnds.h).
enum class AnalysisDepth { Whole, Tracks, Trial };

/// What an analysis delivers while it runs, and how far it goes.
struct AnalysisRequest {
    StatisticSink statistic{};
    PictureSink pictures{};
    /// A first estimate of the calibration gives a preliminary threshold sooner; nothing else of the run differs.
    CalibrationDepth calibration = CalibrationDepth::Refined;
    AnalysisDepth depth = AnalysisDepth::Whole;
    bool keepsFirstTracks = false; ///< sets Analysis::firstTracks
};

/// The pipeline: recording → frames → normalised frames → detector → threshold, clusters, tracks.
///
/// Used by window, command line and library alike. Parts of `previous`, if given, are reused where they are still
/// valid. Streams: memory is bounded for any recording length. Throws Error, Cancelled.
std::shared_ptr<Analysis> analyse(RecordingPointer recording, const AnalysisSettings &settings,
                                  const RunContext &context = {}, const Analysis *previous = nullptr,
                                  const AnalysisRequest &request = {});

/// The same from ready-made frames on any grid, with the settings' own model or bank of models (reuses the input
/// picture and the band of ln K of `previous`) …
std::shared_ptr<const Analysis> analyse(NormalisedFramesPointer frames, const AnalysisSettings &settings,
                                        const RunContext &context = {}, const Analysis *previous = nullptr,
                                        const StatisticSink &sink = {});

/// … or with a given model.
std::shared_ptr<const Analysis> analyse(NormalisedFramesPointer frames, const MarkovModel &model,
                                        const AnalysisSettings &settings, const RunContext &context = {},
                                        const StatisticSink &sink = {});

} // namespace faintline
