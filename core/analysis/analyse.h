#pragma once

#include "analysis/Analysis.h"
#include "analysis/PicturesSoFar.h"
#include "analysis/events.h"
#include "base/RunContext.h"

#include <functional>
#include <memory>
#include <span>

namespace faintline {

/// Called with every block of frames' statistic, in order: first frame, frames × cells values.
using StatisticSink = std::function<void(Index firstFrame, std::span<const float> statistic)>;

/// What an analysis is made for: everything; its tracks, without pictures and checkpoints; or a trial of its settings,
/// whose tracks are not held against the recording's own noise (overOwnNoise.h) either.
enum class AnalysisDepth { Whole, Tracks, Trial };

/// The pipeline: recording → frames → normalised frames → detector → threshold, clusters, tracks.
///
/// Every caller, window, command line and library, comes through here. `previous`, if given, lends what is still valid.
/// Streams: memory is bounded for any recording length. Throws Error, Cancelled.
/// A first estimate of the threshold is there sooner and is not the last word; nothing else of the run differs.
std::shared_ptr<Analysis> analyse(RecordingPointer recording, const AnalysisSettings &settings,
                                  const RunContext &context = {}, const Analysis *previous = nullptr,
                                  const StatisticSink &sink = {}, const PictureSink &pictures = {},
                                  CalibrationDepth calibrationDepth = CalibrationDepth::Refined,
                                  AnalysisDepth depth = AnalysisDepth::Whole);

/// The same from ready-made frames on any grid, with the settings' own model or bank of models (`previous` lends its
/// picture of the input and the band of ln K) …
std::shared_ptr<const Analysis> analyse(NormalisedFramesPointer frames, const AnalysisSettings &settings,
                                        const RunContext &context = {}, const Analysis *previous = nullptr,
                                        const StatisticSink &sink = {});

/// … or with a model of one's own.
std::shared_ptr<const Analysis> analyse(NormalisedFramesPointer frames, const MarkovModel &model,
                                        const AnalysisSettings &settings, const RunContext &context = {},
                                        const StatisticSink &sink = {});

} // namespace faintline
