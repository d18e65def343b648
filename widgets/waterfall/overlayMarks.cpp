#include "widgets/waterfall/overlayMarks.h"

#include <QCoreApplication>

#include <algorithm>
#include <unordered_map>

namespace faintline {

namespace {

    /// The points of a track from one to another, both included.
    OverlayLine stretchOf(const Track &track, std::size_t first, std::size_t last, const Axis &time,
                          const Axis &frequency)
    {
        OverlayLine line{track.id, {}};
        line.points.reserve(qsizetype(last - first + 1));
        const auto at = [&](std::size_t i, double cell) {
            return QPointF(time.value(double(track.points[i].frame)), frequency.value(cell));
        };
        for (std::size_t i = first; i <= last; ++i)
            line.points << at(i, track.lastPosition(i, frequency));
        if (first == last && track.points.size() > 1) { // a dash, as wide as the frame
            const QPointF half(0.5 * time.step, 0.0);
            line.points = {line.points[0] - half, line.points[0] + half};
        }
        if (!track.hasSecondPass())
            return line;
        for (std::size_t i = first; i <= last; ++i)
            line.band << at(i, double(track.smoothed[i].low));
        for (std::size_t i = last + 1; i-- > first;)
            line.band << at(i, double(track.smoothed[i].high));
        return line;
    }

} // namespace

std::vector<OverlayLine> overlayLines(const std::vector<Track> &followed, const Axis &time, const Axis &frequency)
{
    std::vector<OverlayLine> lines;
    for (const Track &track : followed) {
        const std::vector<std::size_t> present = track.presentPoints();
        for (std::size_t from = 0, to = 1; to <= present.size(); ++to)
            if (to == present.size() || present[to] != present[to - 1] + 1) {
                lines.push_back(stretchOf(track, present[from], present[to - 1], time, frequency));
                from = to;
            }
    }
    return lines;
}

std::vector<OverlayBox> overlayBoxes(const std::vector<AreaEvent> &areas)
{
    std::vector<OverlayBox> boxes;
    for (const AreaEvent &area : areas)
        boxes.push_back({{{area.onsetSeconds, area.endSeconds}, {area.low, area.high}},
                         QCoreApplication::translate("OverlayItem", "area"),
                         false});
    return boxes;
}

std::vector<OverlayLine> overlayLines(const std::vector<TruthLine> &known)
{
    std::vector<OverlayLine> lines;
    for (const TruthLine &one : known) {
        if (one.frequencyHz.empty())
            continue;
        OverlayLine line;
        for (std::size_t i = 0; i < one.frequencyHz.size(); ++i) {
            const double seconds = one.startSeconds + double(i) * one.stepSeconds;
            line.points << QPointF(std::min(seconds, one.endSeconds), one.frequencyHz[i]);
        }
        if (line.points.back().x() < one.endSeconds)
            line.points << QPointF(one.endSeconds, one.frequencyHz.back());
        lines.push_back(std::move(line));
    }
    return lines;
}

TrackStage stageOf(const Event &event)
{
    if (!event.isOpen)
        return TrackStage::Ended;
    return event.isConfirmed ? TrackStage::Confirmed : TrackStage::Provisional;
}

std::vector<OverlayMark> overlayMarks(const std::vector<Event> &events, const std::vector<OverlayLine> &lines,
                                      double frameSeconds, double binHz)
{
    std::unordered_map<int, QPolygonF> pointsOf; // of all stretches of a track
    for (const OverlayLine &line : lines)
        pointsOf[line.id] << line.points;
    std::vector<OverlayMark> marks;
    for (const Event &event : events) {
        if (event.position.empty())
            continue;
        const auto track = pointsOf.find(event.id);
        const auto hzAt = [&](double seconds) {
            return event.position.back() + event.driftPerSecond * (seconds - event.detectSeconds);
        };
        QPolygonF points{{event.onsetSeconds, hzAt(event.onsetSeconds)}, {event.endSeconds, hzAt(event.endSeconds)}};
        if (track != pointsOf.end() && !track->second.isEmpty())
            points = track->second;
        OverlayMark mark{
            event.id, {{event.onsetSeconds, event.endSeconds}, {points[0].y(), points[0].y()}}, event.isConfirmed};
        for (const QPointF &point : points) {
            mark.box.frequency.low = std::min(mark.box.frequency.low, point.y());
            mark.box.frequency.high = std::max(mark.box.frequency.high, point.y());
        }
        mark.box.time = {mark.box.time.low - 0.5 * frameSeconds, mark.box.time.high + 0.5 * frameSeconds};
        mark.box.frequency = {mark.box.frequency.low - 0.5 * binHz, mark.box.frequency.high + 0.5 * binHz};
        marks.push_back(mark);
    }
    return marks;
}

} // namespace faintline
