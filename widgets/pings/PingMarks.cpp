#include "widgets/pings/PingMarks.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// The plane on which marks are placed.
    struct MarkedPlane {
        const Grid &grid;
        const FramePlane &plane;

        const Axis &along() const { return grid.axes[plane.along]; }
        const Axis &across() const { return grid.axes[plane.across]; }

        /// Empty if the cell is farther from a cut than its neighbours.
        std::optional<PingMarks::Place> placeOf(Index cell) const
        {
            const std::vector<Index> coordinates = grid.coordinates(cell);
            if (!isIn(coordinates, std::vector<Index>(coordinates.size(), 1)))
                return {};
            return PingMarks::Place{along().value(double(coordinates[plane.along])),
                                    across().value(double(coordinates[plane.across]))};
        }

        /// Whether all cuts lie within centre ± halfWidth, in cells.
        bool isIn(const std::vector<Index> &centre, const std::vector<Index> &halfWidth) const
        {
            for (std::size_t axis = 0; axis < centre.size(); ++axis)
                if (const std::optional<Index> cut = plane.cutOf(axis);
                    cut && std::abs(grid.axes[axis].steps(centre[axis], *cut)) > halfWidth[axis])
                    return false;
            return true;
        }
    };

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

    std::vector<PingMarks::Box> boxesOf(const Analysis &analysis, Index ping, const MarkedPlane &on)
    {
        std::vector<PingMarks::Box> boxes;
        const auto spans = [](const Axis &axis, std::size_t i, const CellBox &box) {
            return spansOf(axis, box.centre[i], box.halfWidth[i]);
        };
        for (const auto &[track, box] : analysis.inhibitions[std::size_t(ping)])
            if (on.isIn(box.centre, box.halfWidth))
                for (const Span &along : spans(on.along(), on.plane.along, box))
                    for (const Span &across : spans(on.across(), on.plane.across, box))
                        boxes.push_back({track, pingsInhibited(analysis, track, ping), along, across});
        return boxes;
    }

    std::optional<PingMarks::Trail> trailOf(const Track &track, const MarkedPlane &on, Index ping, Index tailPings)
    {
        PingMarks::Trail trail{
            track.id, {}, ping >= track.detectFrame, track.isConfirmed && ping >= track.confirmFrame};
        if (ping < track.onsetFrame || ping > std::max(track.endFrame, track.detectFrame))
            return {};
        for (const TrackPoint &point : track.points)
            if (point.frame <= ping && point.frame > ping - tailPings)
                if (const auto place = on.placeOf(point.cell))
                    trail.places.push_back(*place);
        return trail.places.empty() ? std::nullopt : std::optional(trail);
    }

    std::optional<PingMarks::Trail> trailOf(const TruthTarget &target, int id, const MarkedPlane &on, Index ping,
                                            Index tailPings)
    {
        if (target.cellAt(ping) < 0)
            return {};
        PingMarks::Trail trail{id, {}, true, true};
        for (Index k = std::max<Index>(target.firstPing, ping - tailPings + 1); k <= ping; ++k) {
            const auto i = std::size_t(k - target.firstPing);
            if (target.cell[i] >= 0.0 && on.placeOf(Index(target.cell[i])))
                trail.places.push_back(
                    {target.positionOn(on.plane.along, on.grid, i), target.positionOn(on.plane.across, on.grid, i)});
        }
        return trail.places.empty() ? std::nullopt : std::optional(trail);
    }

    bool isJump(const Axis &axis, double from, double to)
    {
        return axis.cyclic && 2.0 * std::abs(to - from) > axis.step * double(axis.count);
    }

} // namespace

const PingMarks::Box *PingMarks::boxAt(const Place &place) const
{
    const auto found = std::find_if(boxes.begin(), boxes.end(), [&](const Box &box) {
        return box.along.contains(place.along) && box.across.contains(place.across);
    });
    return found == boxes.end() ? nullptr : &*found;
}

PingMarks pingMarks(const Analysis &analysis, const std::vector<Track> &tracks, const PingTruth &truth, Index ping,
                    const FramePlane &plane, Index tailPings)
{
    PingMarks marks;
    const MarkedPlane on{analysis.grid(), plane};
    for (const Track &track : tracks) {
        if (auto trail = trailOf(track, on, ping, tailPings))
            marks.tracks.push_back(std::move(*trail));
        if (track.detectFrame == ping && !marks.tracks.empty() && marks.tracks.back().id == track.id)
            marks.detections.push_back({track.id, marks.tracks.back().places.back()});
    }
    for (const Track &track : analysis.conventional)
        if (auto trail = trailOf(track, on, ping, tailPings))
            marks.conventional.push_back(std::move(*trail));
    for (std::size_t i = 0; i < truth.targets.size(); ++i)
        if (auto trail = trailOf(truth.targets[i], int(i) + 1, on, ping, tailPings))
            marks.truth.push_back(std::move(*trail));
    if (analysis.settings.decide.inhibits && ping < std::ssize(analysis.inhibitions))
        marks.boxes = boxesOf(analysis, ping, on);
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
            const double here = target.positionOn(axis, grid, i);
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
