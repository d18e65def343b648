#include "refine/trimEnds.h"

#include "refine/numberByDetection.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index edgeFrames = 1; ///< of a signal that fills part of their window: windows overlap

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
        track.keepPoints(std::size_t(std::max<Index>(0, first - edgeFrames)),
                         std::size_t(std::min(std::ssize(track.smoothed), end + edgeFrames)));
        track.keepDecisionsIn(start + first, start + end - 1);
    }

} // namespace

std::vector<Track> withEndsTrimmed(std::vector<Track> tracks)
{
    const bool areSeenTwice = std::ranges::any_of(tracks, [](const Track &track) { return !track.smoothed.empty(); });
    if (!areSeenTwice) // numbered by a chain, of which a listener may have told
        return tracks;
    for (Track &track : tracks)
        trimEnds(track);
    numberByDetection(tracks);
    return tracks;
}

} // namespace faintline
