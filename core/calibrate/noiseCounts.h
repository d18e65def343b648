#pragma once

#include "calibrate/constants.h"
#include "frames/NormalisedFrames.h"
#include "track/DetectionChain.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

// Additive counts of detectors and chains on noise, segment by segment.

/// Levels at which the exceedance of a statistic is counted.
struct StatisticLevels {
    float lowest = 0.0f;
    float step = 1.0f;
};

/// Statistic of a detector without inhibition.
struct NoiseTail {
    std::vector<double> counts = std::vector<double>(levelCount, 0.0); ///< cells per level bin
    std::vector<float> blockMaxima;
    double cellFrames = 0.0;
};

/// Events of chains with given thresholds.
struct EventCounts {
    std::vector<double> events;     ///< for each chain …
    std::vector<double> cellFrames; ///< … and amount of noise
};

/// The first frames, computed once for repeated use.
std::shared_ptr<const FrameArray> beginningOf(const NormalisedFrames &noise, Index frames);

/// Levels that suit the statistic's own unit.
StatisticLevels statisticLevelsOf(const NormalisedFrames &noise, Detector &detector);

NoiseTail measureTail(const NormalisedFrames &noise, Detector &detector, const StatisticLevels &levels);

/// Counts the chains' tracks after the settling frames; null chains count nothing.
EventCounts countEvents(const NormalisedFrames &noise, const std::vector<std::unique_ptr<DetectionChain>> &chains);

void add(const NoiseTail &part, NoiseTail &whole);

void add(const EventCounts &part, EventCounts &whole);

} // namespace faintline
