#include "track/trimEnds.h"

#include "track/numberByDetection.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index edgeFrames = 1; ///< of a signal that fills part of their window: windows overlap

    void trimEnds(Track &track)
    {
        const auto isPresent = [](const SmoothedPoint &point) { return point.presence > 0.5f; };
        const auto first = std::find_if(track.smoothed.begin(), track.smoothed.end(), isPresent);
        if (first == track.smoothed.end())
            return;
        const auto last = std::find_if(track.smoothed.rbegin(), track.smoothed.rend(), isPresent).base();
        const auto from = std::max<Index>(0, first - track.smoothed.begin() - edgeFrames);
        const auto to = std::min(std::ssize(track.smoothed), last - track.smoothed.begin() + edgeFrames);
        track.isOpen = track.isOpen && to == std::ssize(track.smoothed);
        track.smoothed.erase(track.smoothed.begin() + to, track.smoothed.end());
        track.smoothed.erase(track.smoothed.begin(), track.smoothed.begin() + from);
        track.points.erase(track.points.begin() + to, track.points.end());
        track.points.erase(track.points.begin(), track.points.begin() + from);
        track.onsetFrame = track.points.front().frame;
        track.endFrame = track.points.back().frame;
        track.detectFrame = std::clamp(track.detectFrame, track.onsetFrame, track.endFrame);
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
