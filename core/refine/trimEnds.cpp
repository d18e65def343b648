#include "refine/trimEnds.h"

#include "refine/numberByDetection.h"

#include <algorithm>

namespace faintline {

void trimEnds(Track &track)
{
    const Index start = track.points.front().frame;
    Index first = 0;
    Index end = std::ssize(track.smoothed);
    while (first < end && !track.isPresent(std::size_t(first)))
        ++first;
    if (first == end)
        return;
    while (!track.isPresent(std::size_t(end - 1)))
        --end;
    const auto isEdge = [&](Index point) {
        return point >= 0 && point < std::ssize(track.smoothed) && track.smoothed[std::size_t(point)].presence > 0.0f;
    };
    const Index last = end - 1;
    track.keepPoints(std::size_t(first - (isEdge(first - 1) ? 1 : 0)), std::size_t(end + (isEdge(end) ? 1 : 0)));
    track.keepDecisionsIn(start + first, start + last);
}

std::vector<Track> withEndsTrimmed(std::vector<Track> tracks)
{
    if (std::ranges::none_of(tracks, &Track::hasSecondPass)) // numbered by a chain, of which a listener may have told
        return tracks;
    for (Track &track : tracks)
        trimEnds(track);
    numberByDetection(tracks);
    return tracks;
}

} // namespace faintline
