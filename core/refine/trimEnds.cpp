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
        const auto from = std::max<Index>(0, first - edgeFrames);
        const auto to = std::min(std::ssize(track.smoothed), end + edgeFrames);
        track.isOpen = track.isOpen && to == std::ssize(track.smoothed);
        track.smoothed.erase(track.smoothed.begin() + to, track.smoothed.end());
        track.smoothed.erase(track.smoothed.begin(), track.smoothed.begin() + from);
        track.points.erase(track.points.begin() + to, track.points.end());
        track.points.erase(track.points.begin(), track.points.begin() + from);
        track.onsetFrame = track.points.front().frame;
        track.endFrame = track.points.back().frame;
        track.detectFrame = std::clamp(track.detectFrame, start + first, start + end - 1);
        if (track.confirmFrame >= 0)
            track.confirmFrame = std::clamp(track.confirmFrame, track.detectFrame, track.endFrame);
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
