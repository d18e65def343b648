#pragma once

#include "base/Axis.h"

namespace faintline {

// The numbers of a plan that were chosen and are no settings.

// ---- settings ------------------------------------------------------------------------------------------------------

inline constexpr double slopeLimitBinsPerFrame = 100.0;
inline constexpr int slopeCountLimit = 1001; ///< of a model
/// Fraction of a step within which a slope in Hz/s is one of the set: four digits convert back to the original slope.
inline constexpr double slopeToleranceSteps = 0.01;

// ---- chain ---------------------------------------------------------------------------------------------------------

/// Statistic below the threshold down to which cells belong to an excursion, as far as noise seldom exceeds it …
inline constexpr double shoulderNats = 8.0;
inline constexpr double shoulderNoiseProbability = 1e-3; ///< … in this fraction of the cells of a frame that decides
/// States from which on tracing a path back over tens of frames takes seconds, and the frames that are then traced.
inline constexpr Index tracedBrieflyFromStates = 1'000'000;
inline constexpr Index onsetFramesOfMany = 16;
inline constexpr Index liveRunUpFrames = 512; ///< over which the chain of a live run traces a path back
inline constexpr int leakageLimitDb = 140;    ///< of a line whose side lobes are followed; stronger ones as this one

// ---- calibration ---------------------------------------------------------------------------------------------------

/// Above the threshold: a track is about a hundred times rarer on noise, ln 100 over a typical slope of the tail.
inline constexpr double sureMarginNats = 3.3;
inline constexpr double tailSlopeHalfWidthNats = 0.5; ///< over which the slope of the tail is taken
/// Exceedance down to which it was simulated: by more than a thousand cells.
inline constexpr double simulatedExceedance = 1e-4;

} // namespace faintline
