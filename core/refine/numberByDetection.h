#pragma once

#include "track/Track.h"

#include <algorithm>
#include <vector>

namespace faintline {

/// Orders tracks by detection, then cell, and numbers them from 1. Precondition: each has a point.
inline void numberByDetection(std::vector<Track> &tracks)
{
    std::stable_sort(tracks.begin(), tracks.end(), [](const Track &a, const Track &b) {
        return a.detectFrame != b.detectFrame ? a.detectFrame < b.detectFrame
                                              : a.points.front().cell < b.points.front().cell;
    });
    int id = 0;
    for (Track &track : tracks)
        track.id = ++id;
}

} // namespace faintline
