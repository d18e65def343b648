#include "analyse/endedTrack.h"

#include "refine/TrackPiece.h"
#include "refine/secondLook.h"
#include "refine/trimEnds.h"

#include <algorithm>

namespace faintline {

bool asksEndedTracks(const AnalysisPlan &plan)
{
    return looksTwice(plan) || cutsOnly(plan);
}

Index framesBesideTrack()
{
    return TrackPiece::extraFrames;
}

Index widestStripHalfWidth(const AnalysisPlan &plan)
{
    return widestHalfWidth(plan.frames->geometry().binsPerCell);
}

std::vector<StripPlace> stripPlaces(const Track &track, Index frameCount, const AnalysisPlan &plan)
{
    std::vector<TrackPiece> pieces;
    addPieces(pieces, track, frameCount, plan.frames->geometry().binsPerCell);
    std::vector<StripPlace> places;
    for (const TrackPiece &piece : pieces)
        for (Index at = 0; at < piece.strip.frameCount(); ++at)
            places.push_back({piece.strip.firstFrame + at, piece.strip.centres[std::size_t(at)]});
    return places;
}

std::optional<Event> eventOfEnded(const Analysis &analysis, const Track &track)
{
    std::vector<Track> left =
        looksTwice(analysis) ? lookTwice(analysis, {track}, {}, {}).tracks : cutToSignals(analysis, {track}, {});
    std::ranges::for_each(left, trimEnds);
    return left.empty() ? std::nullopt : std::optional(events(analysis, left).front());
}

} // namespace faintline
