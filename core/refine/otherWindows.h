#pragma once

#include "plan/Analysis.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// What asking windows has brought.
struct AskedWindows {
    std::vector<Track> tracks;
    bool isTooLong = false;   ///< a window of a quarter sees better what the shortest one knows better
    bool knowsBetter = false; ///< more evidence of most tracks that the shortest window before had brought
};

/// The tracks of the recording's window, the base, and what other windows know better, each asked in its own window.
///
/// The base keeps all its tracks, except pieces of one path, and what stronger signals explain. The windows are asked in
/// the order of the evidence of their strongest tracks, and the tracks X of each by their statistic. Those of shorter
/// windows are asked, those of longer ones if their window sees them better than the base does,
///
///   √T/max(1, m) > √T0/max(1, m0),   T, T0: the windows
///
/// because a signal that moves by m cells within a window has 1/m of its energy in each. m is the root mean square of the
/// movement within T; m0² the mean product of the movements in two successive windows T0, which a random walk does not
/// have. X is kept if what remains of it suffices, as a further run of the chain (searchBehind.h):
///
///   gain over μ·a ≥ sureStatistic   gain: the detector's score of the strongest path around X (bothWays.h)
///   μ(t,f) = Π_S 1 + 2·A_S·|W(d_S)|²
///
/// d_S: distance from the band in which the signal S may be during the window around t (its 5-95 % band), in cells of the
/// coarser of both windows, which cannot tell what S consists of; A_S: the largest power in that band. a: the raised level
/// beside X (areaLevels); areas of the base raise μ as well. What X keeps are its parts: stretches in which it is present
/// over μ·a (BothWays::endsBy) and whose own gain suffices, under the law of the recording's noise in that window, too
/// (evidenceLeft), which is measured apart from the tracks that are asked and from those of known signals. Then
///
///   replacing   X, from its first part to its last, replaces the tracks that follow it, which lie in four of five of
///               their frames within a coarser cell of where it is during T0, if they are pieces of it: each lasts less
///               than half as long, or they follow one after the other. The pieces are not among the S. X has more
///               evidence over its threshold than each piece, and takes their earliest detection. For several pieces the
///               condition on windows does not apply: a spread signal is one track in the window in which it stands out
///               as one, however slow it is.
///   adding      otherwise, each part is a track, unless a follower spans it; or it continues a follower, if X is present
///               all the way between them, as along a line that is fast for a while. Its statistic is its own gain. Its
///               window has to see X and the part better; or, if it is the shorter one, the base's frames have to hold
///               the part's energy, because a line has the same Σ r in both (Parseval), and what the base takes for noise
///               is none:
///
///                 Σ (y - 1)/w ≥ ½ Σ r    y: the base's cells within one of where X is during T0; r: X's power over the
///                                        noise's; w: sum of the main lobe's powers over its largest one, in bins
///   explaining  the tracks of the base's own window that are left are asked again over the floor of those signals of
///               other windows that meet them and have more evidence: what a line spreads over the cells that it passes
///               in a long window makes short tracks there. A track whose gain is below the threshold goes; else it is
///               kept from where it is first present to where it is last.
///   joining     in the end, successive parts of X that were added and still are tracks are one, if the path of X loses
///               less than the threshold between them.
///
/// Windows of fewer than OwnNoiseLaw::fewestFrames frames are not asked. Positions are interpolated between frames, or
/// the means of those in the time from one of the base's frames to the next; statistics are shifted by the difference of
/// the two thresholds, and powers divided by the ratio of the windows, so that both have the same meaning as in the base.
/// The result is renumbered, by detection, then cell. All analyses must have two-sided tracks (secondLook.h). Throws
/// Cancelled.
AskedWindows withOtherWindows(const Analysis &base, std::span<const std::shared_ptr<const Analysis>> others,
                              const RunContext &context = {});

} // namespace faintline
