#pragma once

#include "track/Track.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// Conditions for an encounter of two tracks. Distances are in cells of the axis.
struct EncounterRule {
    double near = 0.0;           ///< distance within which two tracks may exchange their signals
    double endNear = 0.0;        ///< distance of a track's end from another track
    Index endFrames = 3;         ///< frames on either side of such an end
    Index joined = 0;            ///< largest distance in frames of encounters that are merged into one
    Index widening = 0;          ///< frames by which an encounter is extended at both ends
    Index fitFrames = 1;         ///< frames at each end of a track from which its path is extrapolated
    Index extension = 0;         ///< largest number of extrapolated frames
    double farthest = 0.0;       ///< largest standard deviation of an extrapolated position
    double leastDeviation = 0.1; ///< smallest standard deviation of a measured position
};

/// Determines which points of each track lie in an encounter with another track: the two are closer than `near`, or
/// cross, or the other track ends within `endNear`. A signal whose track is lost in an encounter is assumed to
/// continue: the path is extrapolated beyond the track's end (PolynomialFit) as long as its position is known well
/// enough. The end of a track that approached another one from 1.5 `endNear` or farther belongs to the encounter from
/// the distance `endNear` on, because the other signal deflects it, provided that it is at least a quarter of
/// `fitFrames` long and that half of `fitFrames` remain. Precondition: all tracks have the second pass.
std::vector<std::vector<bool>> encounters(const std::vector<Track> &tracks, const EncounterRule &rule);

/// A way from one piece of a track to another, through frames that neither has measured for it: one position for each
/// frame from `firstFrame` on. The first and the last points belong to the pieces.
struct BridgeWay {
    Index firstFrame = 0;
    std::vector<double> positions;     ///< cells
    std::vector<SmoothedPoint> before; ///< at the first frames
    std::vector<SmoothedPoint> after;  ///< at the last frames

    static constexpr Index pieceFrames = 12; ///< of either piece, if it is so long
    Index gap() const { return std::ssize(positions) - std::ssize(before) - std::ssize(after); }
};

/// What the cells along a way say: one point for each frame between the pieces.
struct Bridge {
    std::vector<SmoothedPoint> points;
    std::vector<bool> isSeen; ///< whether it could be seen in a frame, which was observed
    double gain = 0.0;        ///< evidence in these frames, nat
    double absence = 0.0;     ///< largest evidence against the signal in any stretch of them, nat
};

/// Conditions for identities of tracks of lines.
struct RelinkRule {
    double threshold = 0.0; ///< T, nat, the detector's
    double binsPerCell = 1.0;
    Index cells = 0;        ///< of the axis
    Index slopeFrames = 56; ///< m, over which a track's way before and after an encounter is measured
    /// D(r): evidence against a signal of level r in each frame in which nothing is to be seen of it, nat.
    std::function<double(double level)> absence;
    /// Measures ways between pieces in the frames.
    std::function<std::vector<Bridge>(std::span<const BridgeWay>)> measure;
};

/// Assigns the pieces of tracks before and after encounters anew, and joins the pieces of one signal.
///
/// Where two signals meet, a path may go over from one to the other at no cost, and one of the two trackers ends. All
/// tracks are therefore cut where two of them are nearer than 1.8 resolution cells or cross (such frames less than
/// 0.7 m apart count as one encounter, widened by m/5 at both ends), and around an end of a track within 3 cells of
/// another. Pieces are then linked by a minimal-cost assignment (assign.h). From the end of piece a to the beginning of
/// piece b, g frames later,
///
///   cost = ½[(f_a - f_b)²/V + ln(V/v0) + (s_a - s_b)²/W + (L_a - L_b)²/(3 dB)²]
///
///   f, s   position and slope of either piece, extrapolated to the middle of the gap from a polynomial through its
///          nearest m to 4 m frames (more for longer gaps): a straight line, or a parabola if its curvature is
///          significant, which is how whistles continue
///   V, W   their variances: those of both fits, times 6 because neighbouring frames are correlated; q·(g/2)² and 2q,
///          where q is the variance of the pieces' own slopes; v0 = (0.35 cell)² in V
///   L      mean levels in dB
///
/// A link is possible if it costs less than T and the signal could have been seen in few frames of the gap: those that
/// are not within 2.5 cells of any track are at most m/5, and times D at most T (for longer ones see joinTracks.h). Two
/// tracks of which one's end and the other's beginning were seen together for m/5 frames or more are two signals. A
/// track's own way costs T·0.9 at most, so that it is kept unless there is a better one; no link costs T.
///
/// Each chosen link between pieces of different tracks is then measured along a cubic curve, in the cells that no other
/// track hides. Its own cells refute it if the evidence against the signal exceeds T in a stretch of its frames, or if more
/// than m/5 of them were seen and their evidence together is negative; the rest is assigned anew without it.
/// Where a track of at most four times the pieces' level lies within a cell of the curve, the joined track has what was
/// measured of that one: equal signals that meet. Elsewhere it has what was measured along the curve; frames farther
/// than 12 from one in which it was seen, and those that were not observed, have presence 0, and are not reported.
///
/// There the statistic goes on with what the first track gained up to the middle, then the second one; where one of
/// these has its end, with what the other gained. Frames of an encounter are evidence for the signals that meet,
/// whichever of them a track followed: two tracks that change places have as much together as before.
///
/// Precondition: all tracks have the second pass. The result is not ordered. Deterministic.
std::vector<Track> relink(std::vector<Track> tracks, const RelinkRule &rule);

} // namespace faintline
