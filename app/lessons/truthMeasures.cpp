#include "app/lessons/truthMeasures.h"

#include "app/document/Document.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace faintline {

namespace {

    /// The cell of the truth's line or target in a frame; empty if it is absent there.
    std::optional<Index> truthCell(const Document &document, std::size_t line, Index frame)
    {
        const Analysis &analysis = *document.analysis();
        const auto &targets = document.pingTruth().targets; // a truth has either targets or lines
        if (line < targets.size()) {
            const Index cell = targets[line].cellAt(frame);
            return cell < 0 ? std::nullopt : std::optional(cell);
        }
        const auto &lines = document.truth().lines;
        const double seconds = analysis.time().value(double(frame));
        if (line >= lines.size() || seconds < lines[line].startSeconds || seconds > lines[line].endSeconds)
            return {};
        return analysis.grid().axes.front().nearest(lines[line].frequencyAt(seconds));
    }

    bool isNear(const Grid &grid, Index a, Index b)
    {
        constexpr Index reach = 3;
        const std::vector<Index> from = grid.coordinates(a);
        const std::vector<Index> to = grid.coordinates(b);
        for (std::size_t axis = 0; axis < from.size(); ++axis)
            if (std::abs(grid.axes[axis].steps(from[axis], to[axis])) > reach)
                return false;
        return true;
    }

    /// Number of the track's points that are near the truth's line.
    int pointsAlong(const Document &document, const Track &track, std::size_t line)
    {
        const Grid &grid = document.analysis()->grid();
        return int(std::count_if(track.points.begin(), track.points.end(), [&](const TrackPoint &point) {
            const auto cell = truthCell(document, line, point.frame);
            return cell && isNear(grid, *cell, point.cell);
        }));
    }

    bool isAlong(const Document &document, const Track &track, std::size_t line)
    {
        return 2 * pointsAlong(document, track, line) > std::ssize(track.points);
    }

    std::size_t lineCount(const Document &document)
    {
        return std::max(document.truth().lines.size(), document.pingTruth().targets.size());
    }

} // namespace

Following following(const Document &document, std::size_t line)
{
    const Analysis &analysis = *document.analysis();
    std::vector<bool> isThere(std::size_t(analysis.time().count));
    std::vector<bool> isFollowed(isThere.size());
    for (Index frame = 0; frame < analysis.time().count; ++frame)
        isThere[std::size_t(frame)] = truthCell(document, line, frame).has_value();
    const auto first = std::find(isThere.begin(), isThere.end(), true) - isThere.begin();
    Following result;
    for (const Track &track : document.shownTracks()) {
        int together = 0;
        for (const TrackPoint &point : track.points)
            if (const auto cell = truthCell(document, line, point.frame);
                cell && isNear(analysis.grid(), *cell, point.cell)) {
                isFollowed[std::size_t(point.frame)] = true;
                ++together;
            }
        if (2 * together <= std::ssize(track.points))
            continue;
        ++result.tracks;
        result.peak = std::max(result.peak, track.peakStatistic);
        const double seconds = double(track.detectFrame - first) * analysis.time().step;
        result.seconds = std::min(seconds, result.seconds.value_or(seconds));
    }
    const auto there = std::count(isThere.begin(), isThere.end(), true);
    result.share = there ? double(std::count(isFollowed.begin(), isFollowed.end(), true)) / double(there) : 0.0;
    return result;
}

double linesFound(const Document &document)
{
    const std::vector<Track> tracks = document.shownTracks();
    double found = 0.0;
    for (std::size_t line = 0; line < lineCount(document); ++line)
        found += std::any_of(tracks.begin(), tracks.end(),
                             [&](const Track &track) { return isAlong(document, track, line); });
    return found;
}

double falseEvents(const Document &document)
{
    double count = 0.0;
    for (const Track &track : document.shownTracks()) {
        int along = 0;
        for (std::size_t line = 0; line < lineCount(document); ++line)
            along = std::max(along, pointsAlong(document, track, line));
        count += 4 * along < std::ssize(track.points);
    }
    return count;
}

} // namespace faintline
