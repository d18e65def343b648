#pragma once

#include "base/Axis.h"

namespace faintline {

// The numbers of following signals that were chosen and are no settings (TrackSettings, DecideSettings).

/// Factor by which a constant leaks more than a line: where noise falls steeply from 0 Hz on, its side lobes lie on less
/// noise.
inline constexpr double constantLeakageFactor = 10.0;
/// y of a skirt, at least: noise exceeds it once in 3000 cells.
inline constexpr double skirtPower = 8.0;
inline constexpr Index skirtLimitSteps = 16; ///< over which a skirt is followed, at most (ChainSettings::skirtStep)
/// Points on either side over which a path's place within its cell is fitted.
inline constexpr std::size_t fittedPoints = 8;
/// Frames for which two trackers have to be beside each other to be taken for one signal's.
inline constexpr int duplicateAfterFrames = 3;
/// Frames from a change of the model to the one in which it is the better explanation, at most: the rivals' past.
inline constexpr Index rivalFrames = 16;
inline constexpr double changeProbability = 0.05; ///< of another model in the next frame (Blom and Bar-Shalom 1988)
/// Size of the box around two areas over the sum of theirs up to which they are one.
inline constexpr double joinedAreaRatio = 1.2;

} // namespace faintline
