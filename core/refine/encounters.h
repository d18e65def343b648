#pragma once

#include "track/Track.h"

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

} // namespace faintline
