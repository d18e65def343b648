#include "analyse/events.h"

#include "analyse/constants.h"
#include "base/Error.h"
#include "base/logmath.h"
#include "refine/calls.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    struct FittedLine {
        double middle = 0.0; ///< position in the middle between the track's ends
        double slope = 0.0;  ///< per second
    };

    /// Least-squares line through the track's positions along an axis, where its signal is present.
    FittedLine lineThrough(const Track &track, const Axis &time, const Grid &grid, std::size_t along)
    {
        const Axis &axis = grid.axes[along];
        const bool isLast = &axis == &grid.axes.back();
        std::vector<std::size_t> present = track.presentPoints();
        if (std::any_of(present.begin(), present.end(), [&](std::size_t i) { return track.isPresent(i); }))
            std::erase_if(present, [&](std::size_t i) { return !track.isPresent(i); });
        const auto n = double(present.size());
        double sumT = 0.0;
        double sumF = 0.0;
        double sumTT = 0.0;
        double sumTF = 0.0;
        double before = 0.0;
        for (const std::size_t i : present) {
            const TrackPoint &point = track.points[i];
            const double t = (double(point.frame) - 0.5 * double(track.onsetFrame + track.endFrame)) * time.step;
            double f =
                axis.value(isLast ? track.lastPosition(i, axis) : double(point.cell / grid.stride(along) % axis.count));
            if (axis.cyclic && i != present.front()) {
                const double turn = axis.step * double(axis.count);
                f += turn * std::round((before - f) / turn);
            }
            before = f;
            sumT += t;
            sumF += f;
            sumTT += t * t;
            sumTF += t * f;
        }
        const double spread = n * sumTT - sumT * sumT;
        const double slope = spread > 0.0 ? (n * sumTF - sumT * sumF) / spread : 0.0;
        return {(sumF - slope * sumT) / n, slope};
    }

    /// Sets the properties that only the two-sided second pass gives.
    void describe(Event &event, const Track &track, const AnalysisPlan &analysis)
    {
        const std::vector<std::size_t> present = track.presentPoints();
        const auto count = double(present.size());
        double level = 0.0;
        double band = 0.0;
        for (const std::size_t i : present) {
            const SmoothedPoint &point = track.smoothed[i];
            level += double(point.level) / count;
            band += double(point.high - point.low) / count;
        }
        event.snrDb = dbFromRatio(level);
        event.bandWidth = band * analysis.grid().axes.back().step;
        event.windowSeconds =
            track.windowSeconds > 0.0 ? track.windowSeconds : analysis.frames->geometry().windowSeconds;
        event.kind = kindOf(track, analysis);
        event.noiseProbability = noiseProbability(event.statistic, analysis);
    }

} // namespace

std::vector<AreaEvent> areaEvents(const Analysis &analysis)
{
    const Axis &time = analysis.time();
    const Axis &axis = analysis.grid().axes.back();
    std::vector<AreaEvent> result;
    for (const Area &area : analysis.areas)
        if (const double levelDb = dbFromRatio(area.level); levelDb >= leastAreaDb)
            result.push_back({time.value(double(area.firstFrame)), time.value(double(area.lastFrame)),
                              axis.value(double(area.firstCell)), axis.value(double(area.lastCell)), levelDb});
    return result;
}

std::string unreportedWords(const Analysis &analysis)
{
    const std::size_t paths = analysis.explainedByNoise.size();
    return paths == 0 ? std::string()
                      : std::to_string(paths) + (paths == 1 ? " path" : " paths")
                            + " above the threshold not reported: cells this strong, or runs of them, are common in "
                              "this recording's noise";
}

double noiseProbability(double statistic, const AnalysisPlan &analysis)
{
    const double cellFrames = double(analysis.grid().size()) * double(analysis.time().count);
    return -std::expm1(-analysis.calibration->eventRateAt(statistic) * cellFrames);
}

double statisticOf(const Track &track, const AnalysisPlan &analysis)
{
    return isScoreOfPaths(analysis.settings.detector) ? track.peakStatistic : track.detectStatistic;
}

double snrChangeDb(double hz, const FrameGeometry &geometry)
{
    return dbFromRatio(noiseBandwidthCells(geometry.window) / (geometry.windowSeconds * hz));
}

std::vector<Event> events(const Analysis &analysis)
{
    return events(analysis, analysis.tracks);
}

std::vector<Event> events(const AnalysisPlan &plan, const std::vector<Track> &tracks)
{
    const Axis &time = plan.time();
    const Grid &grid = plan.grid();
    const std::vector<int> calls = callsOf(tracks, plan);
    std::vector<Event> result;
    for (const Track &track : tracks) {
        Event event;
        event.id = track.id;
        event.call = calls[result.size()];
        event.onsetSeconds = time.value(double(track.onsetFrame));
        event.detectSeconds = time.value(double(track.detectFrame));
        if (track.confirmFrame >= 0)
            event.confirmSeconds = time.value(double(track.confirmFrame));
        event.endSeconds = time.value(double(track.endFrame));
        const auto at = std::find_if(track.points.begin(), track.points.end(),
                                     [&](const TrackPoint &point) { return point.frame >= track.detectFrame; });
        const auto detection = std::size_t(std::min(at, track.points.end() - 1) - track.points.begin());
        event.detectedPosition = track.positionOf(detection, grid);
        event.position = event.detectedPosition;
        for (std::size_t axis = 0; axis < grid.axes.size(); ++axis) {
            const FittedLine line = lineThrough(track, time, grid, axis);
            event.ratesPerSecond.push_back(line.slope);
            if (grid.isSpectrum())
                event.position.back() = line.middle;
        }
        event.driftPerSecond = event.ratesPerSecond.back();
        event.model = track.model;
        for (const ModelChange &change : track.modelChanges)
            event.modelChanges.push_back({time.value(double(change.frame)), change.model});
        event.statistic = statisticOf(track, plan);
        event.isConfirmed = track.isConfirmed;
        event.isOpen = track.isOpen;
        event.isSubtracted = track.isSubtracted;
        if (track.hasSecondPass())
            describe(event, track, plan);
        result.push_back(std::move(event));
    }
    sortEvents(result);
    return result;
}

Event chosenEvent(const Analysis &analysis, int number)
{
    const std::vector<Event> found = events(analysis);
    if (found.empty())
        throw Error("detection", "found no event; a lower threshold finds more (decide.falseAlarmsPerHour)");
    const auto chosen =
        number == 0
            ? std::max_element(found.begin(), found.end(),
                               [](const Event &a, const Event &b) { return a.statistic < b.statistic; })
            : std::find_if(found.begin(), found.end(), [number](const Event &event) { return event.id == number; });
    if (chosen == found.end())
        throw Error("event " + std::to_string(number),
                    "there is no such event; 'detect' lists the " + std::to_string(found.size()) + " there are");
    return *chosen;
}

void sortEvents(std::vector<Event> &events)
{
    std::stable_sort(events.begin(), events.end(), [](const Event &a, const Event &b) {
        return a.onsetSeconds != b.onsetSeconds ? a.onsetSeconds < b.onsetSeconds : a.position < b.position;
    });
}

} // namespace faintline
