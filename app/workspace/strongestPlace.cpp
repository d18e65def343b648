#include "app/workspace/strongestPlace.h"

#include <algorithm>

namespace faintline {

std::optional<PingViewports::Place> strongestPlace(const Document &document)
{
    const std::vector<Event> events = document.shownEvents();
    const auto strongest = std::max_element(events.begin(), events.end(),
                                            [](const Event &a, const Event &b) { return a.statistic < b.statistic; });
    const Track *track = strongest == events.end() ? nullptr : document.track(strongest->id);
    if (!track || track->points.empty())
        return {};
    const Analysis &analysis = *document.analysis();
    const Index middle = (track->detectFrame + track->endFrame) / 2;
    const auto at = std::find_if(track->points.begin(), track->points.end(),
                                 [&](const TrackPoint &point) { return point.frame >= middle; });
    const TrackPoint &point = at == track->points.end() ? track->points.back() : *at;
    const std::vector<Index> c = analysis.grid().coordinates(point.cell);
    return PingViewports::Place{analysis.time().value(double(point.frame)), analysis.grid().axes[0].value(double(c[0])),
                                analysis.grid().axes[1].value(double(c[1]))};
}

} // namespace faintline
