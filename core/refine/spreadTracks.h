#pragma once

#include "plan/Analysis.h"

namespace faintline {

/// Moves the tracks of spread signals (reverberation, modulated noise, a cloud) from the analysis's tracks to its
/// areas: a path through such a signal has a place in each frame, but no line is there.
///
/// A track is spread if, over the frames in which its signal is present, the mean width of its 5-95 % band exceeds
/// 2.2·max(1, 1/√r) resolution cells, r its mean level. At 6 dB or more (r ≥ 4) the position of any signal is known,
/// and a wide band is that of a fast one. A track below sureStatistic may be noise, of which as many tracks are reported
/// as specified. The rule applies to laws with inertia, h(0) ≥ 0.8, under which bands of lines that are constant, drift
/// or wander are at most 1.9 cells wide; under other laws those of all faint lines are wider. Families are left alone.
///
/// Each area spans 25 frames of a track, over which its level is averaged, and the band in them.
void moveSpreadTracks(Analysis &analysis);

} // namespace faintline
