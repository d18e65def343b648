#include "app/features/pictures/strongestPlace.h"

#include <algorithm>

namespace faintline {

std::optional<Event> strongestEvent(const Document &document)
{
    const std::vector<Event> events = document.shownEvents();
    const auto strongest = std::ranges::max_element(events, {}, &Event::statistic);
    return strongest == events.end() ? std::nullopt : std::optional(*strongest);
}

std::optional<PingViewports::Place> strongestPlace(const Document &document)
{
    const std::optional<Event> strongest = strongestEvent(document);
    const Track *track = strongest ? document.track(strongest->id) : nullptr;
    if (!track || track->points.empty())
        return {};
    const Analysis &analysis = *document.analysis();
    const Index middle = (track->detectFrame + track->endFrame) / 2;
    const auto at = std::find_if(track->points.begin(), track->points.end(),
                                 [&](const TrackPoint &point) { return point.frame >= middle; });
    const TrackPoint &point = at == track->points.end() ? track->points.back() : *at;
    return PingViewports::Place{analysis.time().value(double(point.frame)), analysis.grid().position(point.cell)};
}

} // namespace faintline
