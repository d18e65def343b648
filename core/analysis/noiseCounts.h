#pragma once

#include "spectrum/NormalisedFrames.h"
#include "track/DetectionChain.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

// What detectors and chains do on noise, segment by segment: counts that add up.

inline constexpr int settlingFrames = 300;     ///< of a segment, that do not count
inline constexpr Index noiseBlockFrames = 128; ///< of the blocks whose maxima are kept …
inline constexpr Index noiseBlockCells = 64;   ///< … and their cells
inline constexpr std::size_t levelCount = 2000;

/// StatisticLevels at which a statistic's exceedance is counted.
struct StatisticLevels {
    float lowest = 0.0f;
    float step = 1.0f;
};

/// What a detector that nothing is kept from does.
struct NoiseTail {
    std::vector<double> counts = std::vector<double>(levelCount, 0.0); ///< cells per level bin
    std::vector<float> blockMaxima;
    double cellFrames = 0.0;
};

/// What chains with their thresholds do.
struct EventCounts {
    std::vector<double> events;     ///< of each chain …
    std::vector<double> cellFrames; ///< … and in how much noise
};

/// The frames from the start on, computed once for what goes through them many times.
std::shared_ptr<const FrameArray> beginningOf(const NormalisedFrames &noise, Index frames);

/// StatisticLevels that suit the statistic's own unit.
StatisticLevels statisticLevelsOf(const NormalisedFrames &noise, Detector &detector);

NoiseTail measureTail(const NormalisedFrames &noise, Detector &detector, const StatisticLevels &levels);

/// The chains' tracks after the settling frames; null chains count nothing.
EventCounts countEvents(const NormalisedFrames &noise, const std::vector<std::unique_ptr<DetectionChain>> &chains);

void add(const NoiseTail &part, NoiseTail &whole);

void add(const EventCounts &part, EventCounts &whole);

} // namespace faintline
