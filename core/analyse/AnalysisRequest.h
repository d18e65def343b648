#pragma once

#include "calibrate/CalibrationDepth.h"
#include "plan/Analysis.h"

#include <functional>
#include <memory>
#include <optional>
#include <span>

namespace faintline {

/// Called for each block of frames of the statistic, in order: first frame, frames × cells values.
using StatisticSink = std::function<void(Index firstFrame, std::span<const float> statistic)>;

/// Pictures of a recording while it is still being analysed.
struct PicturesSoFar {
    std::shared_ptr<const PeakPyramid> quickLook; ///< y in dB at some times of the whole recording
    std::shared_ptr<const PeakPyramid> input;     ///< y in dB up to the current frame; null before the chain starts
    std::shared_ptr<const PeakPyramid> statistic; ///< D in nats, likewise
    Axis time;                                    ///< of all frames
    Axis frequency;
};

/// Called by the computing thread a few times per second. It does not change any result.
using PictureSink = std::function<void(const PicturesSoFar &)>;

/// Scope of an analysis: everything; its tracks, without pictures, histogram and checkpoints; or a trial of its
/// settings, whose tracks are also not tested against the recording's own noise (ownNoiseLaw.h), which is not searched
/// for signals behind others (secondLook.h), and whose tracks are not trimmed to their signals (trimEnds.h).
enum class AnalysisDepth { Whole, Tracks, Trial };

/// What an analysis starts from, what it delivers while it runs, and how far it goes.
struct AnalysisRequest {
    const Analysis *previous = nullptr; ///< whose parts are used again where they are still valid
    StatisticSink statistic{};
    /// Called before the statistic, with the frames of which it is one. If the recording determines the window, its
    /// statistic takes a second run in that window.
    std::function<void(const NormalisedFrames &)> statisticBegins{};
    PictureSink pictures{}; ///< not called for frames on several axes
    /// A first estimate of the calibration gives a preliminary threshold sooner; nothing else of the run differs. Frames
    /// that are not of a recording always have the refined one.
    CalibrationDepth calibration = CalibrationDepth::Refined;
    AnalysisDepth depth = AnalysisDepth::Whole;
    std::optional<MarkovModel> model{}; ///< of ready-made frames, in place of the settings'
};

} // namespace faintline
