#pragma once

#include "recursion/PathStrip.h"
#include "track/Track.h"

#include <vector>

namespace faintline {

/// A track as detected, or a piece of a long one, with the strip of frames around it that the second pass reads.
///
/// Tracks of more than 4096 frames are cut into equal pieces, so that memory is bounded. A piece's strip also covers 64
/// frames of its neighbours, so that the pass sees past and future at the cuts, and `extraFrames` beyond the track's
/// ends, where its path goes on with its slope over the last 24 frames. It is as wide as the pass needs, and around
/// strong tracks (above 2 nats per frame) wide enough for their skirts.
struct TrackPiece {
    const Track *track;
    std::size_t from; ///< points
    std::size_t to;   ///< one past the last
    PathStrip strip;

    static constexpr Index extraFrames = 16; ///< before and after a path, in which presence is evaluated

    bool isFirst() const { return from == 0; }
    bool isLast() const { return to == track->points.size(); }
};

/// Half width in bins of the widest strip of a piece.
Index widestHalfWidth(double binsPerCell);

/// Appends the pieces of a track, in time, with empty strips: positions without values. `frameCount`: of all frames.
/// The track must outlive its pieces.
void addPieces(std::vector<TrackPiece> &pieces, const Track &track, Index frameCount, double binsPerCell);

} // namespace faintline
