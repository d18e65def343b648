#pragma once

#include "calibrate/constants.h"
#include "frames/NormalisedFrames.h"
#include "plan/AnalysisPlan.h"

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

/// Events of a chain at given thresholds.
struct EventCounts {
    std::vector<double> events;     ///< at each threshold …
    std::vector<double> cellFrames; ///< … and amount of noise
};

/// The first frames, computed once for repeated use.
std::shared_ptr<const FrameArray> beginningOf(const NormalisedFrames &noise, Index frames);

/// Levels that suit the statistic's own unit.
StatisticLevels statisticLevelsOf(const NormalisedFrames &noise, Detector &detector);

NoiseTail measureTail(const NormalisedFrames &noise, Detector &detector, const StatisticLevels &levels);

/// Counts the tracks of the plan's chain at each of these thresholds, after the settling frames. `onlyAtLast`: none at
/// the others, which more events cross, so that they cost more.
EventCounts countEvents(const AnalysisPlan &plan, std::span<const double> thresholds, bool onlyAtLast);

void add(const NoiseTail &part, NoiseTail &whole);

void add(const EventCounts &part, EventCounts &whole);

} // namespace faintline
