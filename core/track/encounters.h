#pragma once

#include "track/Track.h"

#include <vector>

namespace faintline {

/// Conditions for an encounter of two tracks.
struct EncounterRule {
    double near = 0.0;           ///< distance within which two tracks may have changed places, cells of the axis
    double endNear = 0.0;        ///< distance of a track's end from another one
    Index endFrames = 3;         ///< frames on either side of such an end
    Index joined = 0;            ///< encounters up to this many frames apart are one
    Index widening = 0;          ///< frames by which an encounter is longer at both ends
    Index fitFrames = 1;         ///< at either end of a track, from which its way beyond is extrapolated
    Index extension = 0;         ///< number of frames by which it is at most
    double farthest = 0.0;       ///< largest standard deviation of an extrapolated position, cells of the axis
    double leastDeviation = 0.1; ///< of measured positions, cells of the axis
};

/// Which points of each track lie in an encounter with another one: the two are nearer than `near` or their difference
/// changes sign, or the other one ends within `endNear`. A track that is lost in an encounter is still there: where it
/// ends, its way is extrapolated (PolynomialFit), as far as it is known. Tracks without the second pass have none.
std::vector<std::vector<bool>> encounters(const std::vector<Track> &tracks, const EncounterRule &rule);

} // namespace faintline
