#pragma once

#include "base/Axis.h"

namespace faintline {

// The numbers of an analysis that were chosen and are no settings.

// ---- choice of the window ------------------------------------------------------------------------------------------

inline constexpr double windowRatio = 4.0; ///< of consecutive windows
/// Energy along its tracks that a longer window keeps: below it it loses moving signals …
inline constexpr double lostEnergyShare = 1.0 / 3.0;
inline constexpr double keptEnergyShare = 0.85;    ///< … and from there on almost nothing
inline constexpr double narrowestBandCells = 24.0; ///< resolution cells of the band, in the shortest window
inline constexpr double fewestTrialFrames = 16.0;  ///< windows of the recording, in the longest one
inline constexpr std::size_t windowTrialLimit = 5;

// ---- results -------------------------------------------------------------------------------------------------------

inline constexpr double leastAreaDb = 1.0; ///< level of an area that is reported

// ---- regulated K ---------------------------------------------------------------------------------------------------

inline constexpr int regulationSettlingFrames = 150; ///< of simulated noise …
inline constexpr int regulationNoiseFrames = 400;    ///< … of so many, from which its band is taken

// ---- pictures and checkpoints --------------------------------------------------------------------------------------

inline constexpr double quickLookSamples = 33554432.0; ///< that are transformed: a fraction of a second
inline constexpr Index quickLookFrameLimit = 256;
inline constexpr Index fewestQuickLookFrames = 32;
inline constexpr Index fewestCheckpointFrames = 64; ///< from one checkpoint to the next

} // namespace faintline
