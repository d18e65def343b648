#pragma once

#include "plan/AnalysisPlan.h"
#include "track/Track.h"

#include <string>

namespace faintline {

/// What a track follows.
enum class SignalKind {
    Unknown, ///< without the second pass (secondLook.h)
    Line,
    Keyed, ///< a line with two pauses or more
    Spread ///< a signal that is wider than a line: reverberation, modulated noise, a cloud. The track is its centre.
};

/// "", "line", "keyed" or "spread".
std::string nameOf(SignalKind kind);

/// Pauses are those of Track::presentPoints between the track's ends, in frames that were observed: each has evidence
/// of T/2 for its begin and its end (bothWays.h).
///
/// A track is spread if, over the frames in which its signal is present, the mean width of its 5-95 % band exceeds
/// 2.2·max(1, 1/√r) resolution cells, r its mean power over the noise's in one frame. At 6 dB or more (r ≥ 4) the
/// position of any signal is known, and a wide band is that of a fast one. A track below sureStatistic may be noise,
/// and is called a line. The rule applies to laws with inertia, h(0) ≥ 0.8, under which bands of lines that are constant,
/// drift or wander are at most 1.9 cells wide; under other laws those of all faint lines are wider. Families are lines
/// or keyed, as are tracks of other windows (otherWindows.h), which are asked only if they are not spread there.
SignalKind kindOf(const Track &track, const AnalysisPlan &plan);

} // namespace faintline
