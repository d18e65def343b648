#include "widgets/pings/PingMarks.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    PingMarks::Place placeOf(const Grid &grid, Index cell)
    {
        const Index beams = grid.axes[1].count;
        return {grid.axes[0].value(double(cell / beams)), grid.axes[1].value(double(cell % beams))};
    }

    /// The spans of cells centre ± half on an axis: two if they wrap around the end of a cyclic axis.
    std::vector<Span> spansOf(const Axis &axis, Index centre, Index half)
    {
        const auto span = [&](Index first, Index last) {
            return Span{axis.value(double(first) - 0.5), axis.value(double(last) + 0.5)};
        };
        const Index last = axis.count - 1;
        if (!axis.cyclic || 2 * half + 1 >= axis.count)
            return {span(std::max<Index>(centre - half, 0), std::min(centre + half, last))};
        const Index low = centre - half;
        const Index high = centre + half;
        if (low < 0)
            return {span(low + axis.count, last), span(0, high)};
        if (high > last)
            return {span(low, last), span(0, high - axis.count)};
        return {span(low, high)};
    }

    /// Number of consecutive pings up to this one with an inhibited box for a track.
    int pingsInhibited(const Analysis &analysis, int track, Index ping)
    {
        const auto isIn = [track](const auto &inhibitions) {
            return std::any_of(inhibitions.begin(), inhibitions.end(),
                               [track](const auto &one) { return one.track == track; });
        };
        int count = 0;
        while (ping >= count && isIn(analysis.inhibitions[std::size_t(ping - count)]))
            ++count;
        return count;
    }

    std::vector<PingMarks::Box> boxesOf(const Analysis &analysis, Index ping)
    {
        std::vector<PingMarks::Box> boxes;
        const Grid &grid = analysis.grid();
        for (const auto &[track, box] : analysis.inhibitions[std::size_t(ping)])
            for (const Span &range : spansOf(grid.axes[0], box.centre[0], box.halfWidth[0]))
                for (const Span &bearing : spansOf(grid.axes[1], box.centre[1], box.halfWidth[1]))
                    boxes.push_back({track, pingsInhibited(analysis, track, ping), range, bearing});
        return boxes;
    }

    std::optional<PingMarks::Trail> trailOf(const Track &track, const Grid &grid, Index ping, Index tailPings)
    {
        PingMarks::Trail trail{
            track.id, {}, ping >= track.detectFrame, track.isConfirmed && ping >= track.confirmFrame};
        if (ping < track.onsetFrame || ping > std::max(track.endFrame, track.detectFrame))
            return {};
        for (const TrackPoint &point : track.points)
            if (point.frame <= ping && point.frame > ping - tailPings)
                trail.places.push_back(placeOf(grid, point.cell));
        return trail.places.empty() ? std::nullopt : std::optional(trail);
    }

    std::optional<PingMarks::Trail> trailOf(const TruthTarget &target, int id, Index ping, Index tailPings)
    {
        if (target.cellAt(ping) < 0)
            return {};
        PingMarks::Trail trail{id, {}, true, true};
        for (Index k = std::max<Index>(target.firstPing, ping - tailPings + 1); k <= ping; ++k) {
            const auto i = std::size_t(k - target.firstPing);
            if (target.cell[i] >= 0.0)
                trail.places.push_back({target.rangeMetres[i], target.bearingDegrees[i]});
        }
        return trail;
    }

    bool isJump(const Axis &axis, double from, double to)
    {
        return axis.cyclic && 2.0 * std::abs(to - from) > axis.step * double(axis.count);
    }

} // namespace

const PingMarks::Box *PingMarks::boxAt(const Place &place) const
{
    const auto found = std::find_if(boxes.begin(), boxes.end(), [&](const Box &box) {
        return box.range.contains(place.range) && box.bearing.contains(place.bearing);
    });
    return found == boxes.end() ? nullptr : &*found;
}

PingMarks pingMarks(const Analysis &analysis, const std::vector<Track> &tracks, const PingTruth &truth, Index ping,
                    Index tailPings)
{
    PingMarks marks;
    const Grid &grid = analysis.grid();
    for (const Track &track : tracks) {
        if (auto trail = trailOf(track, grid, ping, tailPings))
            marks.tracks.push_back(std::move(*trail));
        if (track.detectFrame == ping && !marks.tracks.empty() && marks.tracks.back().id == track.id)
            marks.detections.push_back({track.id, marks.tracks.back().places.back()});
    }
    for (const Track &track : analysis.conventional)
        if (auto trail = trailOf(track, grid, ping, tailPings))
            marks.conventional.push_back(std::move(*trail));
    for (std::size_t i = 0; i < truth.targets.size(); ++i)
        if (auto trail = trailOf(truth.targets[i], int(i) + 1, ping, tailPings))
            marks.truth.push_back(std::move(*trail));
    if (analysis.settings.decide.inhibits && ping < std::ssize(analysis.inhibitions))
        marks.boxes = boxesOf(analysis, ping);
    return marks;
}

std::vector<Track> tracksAlong(const std::vector<Track> &tracks, const Grid &grid, std::size_t axis)
{
    const Axis &along = grid.axes[axis];
    const Index stride = grid.stride(axis);
    std::vector<Track> result;
    for (const Track &track : tracks) {
        result.push_back(track);
        result.back().points.clear();
        double before = 0.0;
        for (TrackPoint point : track.points) {
            point.cell = point.cell / stride % along.count;
            const double here = along.value(double(point.cell));
            if (!result.back().points.empty() && isJump(along, before, here)) {
                result.push_back(track);
                result.back().points.clear();
            }
            result.back().points.push_back(point);
            before = here;
        }
    }
    return result;
}

std::vector<Event> eventsAlong(std::vector<Event> events, std::size_t axis)
{
    for (Event &event : events) {
        event.position = {event.position[axis]};
        event.driftPerSecond = event.ratesPerSecond[axis];
        event.ratesPerSecond = {event.driftPerSecond};
    }
    return events;
}

std::vector<TruthLine> truthAlong(const PingTruth &truth, const Grid &grid, const Axis &time, std::size_t axis)
{
    std::vector<TruthLine> lines;
    for (const TruthTarget &target : truth.targets) {
        bool isOn = false;
        for (std::size_t i = 0; i < target.cell.size(); ++i) {
            if (target.cell[i] < 0.0) {
                isOn = false;
                continue;
            }
            const double here = axis == 0 ? target.rangeMetres[i] : target.bearingDegrees[i];
            if (!isOn || isJump(grid.axes[axis], lines.back().frequencyHz.back(), here)) {
                TruthLine line;
                line.snrDb = target.snrDb;
                line.stepSeconds = time.step;
                line.startSeconds = time.value(double(target.firstPing) + double(i));
                lines.push_back(line);
            }
            isOn = true;
            lines.back().frequencyHz.push_back(here);
            lines.back().endSeconds = time.value(double(target.firstPing) + double(i));
        }
    }
    return lines;
}

} // namespace faintline
