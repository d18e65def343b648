#pragma once

#include "track/Track.h"

namespace faintline {

// Tracks with a second pass, by frame instead of by point. Precondition: at least one point.

inline bool isThere(const Track &track, Index frame)
{
    return frame >= track.points.front().frame && frame <= track.points.back().frame;
}

/// Index of the point at a frame. Precondition: isThere.
inline std::size_t pointIndex(const Track &track, Index frame)
{
    return std::size_t(frame - track.points.front().frame);
}

/// Position at a frame, in cells of the axis. Precondition: isThere.
inline double positionAt(const Track &track, Index frame)
{
    return track.smoothed[pointIndex(track, frame)].position;
}

} // namespace faintline
