#include "analyse/analyse.h"
#include "base/Random.h"
#include "inspect/StateReplay.h"
#include "inspect/explain.h"
#include "support/frames.h"
#include "support/test.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

constexpr Index frameCount = 90;
constexpr Index cellCount = 48;

/// Noise with a line that climbs a cell every third frame from frame 20 to 59.
std::shared_ptr<const Analysis> scaledInjection(double thresholdNats, double linkCells = 3.0, Index frames = frameCount)
{
    std::vector<float> y(std::size_t(frames * cellCount));
    Random random(8, 1);
    random.exponentials(y);
    for (Index frame = 20; frame < 60; ++frame)
        y[std::size_t(frame * cellCount + 15 + (frame - 20) / 3)] += 5.0f;
    for (Index frame = frames - 300; frame < frames; ++frame)
        if (frames > frameCount)
            y[std::size_t(frame * cellCount + 30)] += 4.0f;
    AnalysisSettings settings;
    settings.detector = SmdSettings{SmdSettings::Reset::Fixed, 0.6};
    settings.decide.by = DecideSettings::By::Nats;
    settings.decide.thresholdNats = thresholdNats;
    settings.decide.linkCells = {linkCells};
    settings.model.slopeChange = {0.5, 0.2, 0.05};
    return analyse(test::framesOf(cellCount, std::move(y), 0.25, 0.5), settings);
}

Explanation at(const Analysis &analysis, Index frame, Index cell)
{
    return explain(analysis, analysis.time().value(double(frame)), {analysis.grid().axes[0].value(double(cell))});
}

/// The best two of the ways into a state in a frame, from all states' scores in the frame before.
std::pair<double, double> bestWays(const StateSpace &space, const std::vector<float> &before, Index state, Index frame)
{
    std::pair best{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const StateSpace::Predecessor &p : space.predecessors(state, frame)) {
        const double score = double(before[std::size_t(p.state)]) + p.lnProbability;
        if (score > best.first)
            best = {score, best.first};
        else
            best.second = std::max(best.second, score);
    }
    return best;
}

} // namespace

class tst_explainLines : public QObject
{
    Q_OBJECT

private slots:
    void runnerUpsAndResetsAreThoseOfAllStates()
    {
        const auto analysis = scaledInjection(1000.0); // no track: nothing is forgotten
        const StateSpace &space = analysis->model.space;
        StateReplay replay(analysis);
        int resets = 0;
        for (const Index frame : {0, 5, 30, 55, 80})
            for (Index cell = 1; cell < cellCount; cell += 5) {
                const Explanation why = at(*analysis, frame, cell);
                for (const PathStep &step : why.steps) {
                    if (&step == &why.steps.front())
                        continue;
                    const auto [best, second] =
                        bestWays(space, replay.at(step.frame - 1)->values, step.state, step.frame);
                    QVERIFY(std::abs(step.runnerUp - (best - second)) < 1e-4);
                }
                const PathStep &first = why.steps.front();
                QVERIFY(std::isinf(first.runnerUp));
                if (first.frame == 0) {
                    QCOMPARE(why.reset.kind, ResetCause::Kind::Beginning);
                    continue;
                }
                QCOMPARE(why.reset.kind, ResetCause::Kind::Background);
                const double goingOn =
                    bestWays(space, replay.at(first.frame - 1)->values, first.state, first.frame).first + 0.6;
                QVERIFY(goingOn <= 1e-6);
                if (std::isfinite(goingOn)) // else nothing leads there: the slope comes from beyond the band
                    QVERIFY2(std::abs(why.reset.lost + goingOn) < 1e-6,
                             qPrintable(QString::number(why.reset.lost + goingOn)));
                else
                    QCOMPARE(why.reset.lost, -goingOn);
                ++resets;
            }
        QVERIFY(resets > 20);
    }

    void theOtherStateIsTheNextBestOfTheCell()
    {
        const auto analysis = scaledInjection(14.0);
        QVERIFY(!analysis->tracks.empty());
        StateReplay replay(analysis);
        for (const Index frame : {10, 50}) {
            for (Index cell = 3; cell < cellCount; cell += 4) {
                const Explanation why = at(*analysis, frame, cell);
                std::vector<float> scores;
                for (Index plane = 0; plane < analysis->model.space.planeCount(); ++plane)
                    scores.push_back(replay.at(frame)->values[std::size_t(plane * cellCount + cell)]);
                const float other = replay.at(frame)->values[std::size_t(*why.otherState)];
                std::sort(scores.rbegin(), scores.rend());
                QCOMPARE(other, scores[1]);
                QVERIFY(std::abs(why.otherMargin - double(scores[0] - scores[1])) < 1e-6);
            }
        }
    }

    void whatATrackTookOverIsForgotten()
    {
        const auto analysis = scaledInjection(14.0, 8.0); // so much round a cluster is forgotten with it
        const Track &track = analysis->tracks.front();
        int forgotten = 0;
        for (Index cell = track.points.front().cell - 12; cell < track.points.front().cell + 24; ++cell) {
            const Explanation why = at(*analysis, track.detectFrame + 1, cell);
            if (why.reset.kind != ResetCause::Kind::Forgotten)
                continue;
            ++forgotten;
            QCOMPARE(why.reset.track, track.id);
            QVERIFY(why.reset.lost > 0.0);
            QCOMPARE(why.steps.front().frame, track.detectFrame + 1);
        }
        QVERIFY(forgotten > 0);
    }

    void inhibitedCellsNameTheirTrack()
    {
        const auto analysis = scaledInjection(14.0);
        const Track &track = analysis->tracks.front();
        const TrackPoint &point = track.points.back();
        QCOMPARE(at(*analysis, point.frame, point.cell).inhibitedFor, std::optional(track.id));
        QVERIFY(!at(*analysis, point.frame, (point.cell + 20) % cellCount).inhibitedFor);
    }

    void cellsOfTracksThatNoiseExplainsAreTold()
    {
        Analysis analysis = *scaledInjection(14.0);
        const Track track = analysis.tracks.front();
        const auto isExplained = [&](Index frame, Index cell) { return at(analysis, frame, cell).isExplainedByNoise; };
        for (const TrackPoint &point : track.points)
            QVERIFY(!isExplained(point.frame, point.cell));
        analysis.tracks.swap(analysis.explainedByNoise);
        for (const TrackPoint &point : track.points) {
            QVERIFY(isExplained(point.frame, point.cell));
            QVERIFY(!isExplained(point.frame, point.cell + 1));
        }
        QVERIFY(!isExplained(track.points.front().frame - 1, track.points.front().cell));
    }

    void farIntoALongOneItGoesOnFromTheRunsCheckpoints()
    {
        constexpr Index frames = 4096 + 400; // more than a chain remembers
        const auto analysis = scaledInjection(14.0, 3.0, frames);
        QVERIFY(analysis->checkpoints.count() > 60);
        const Track &last = analysis->tracks.back();
        QVERIFY(last.detectFrame > frames - 300
                && last.endFrame > frames - 10); // so one is followed past several checkpoints
        Analysis withoutAny = *analysis;
        withoutAny.checkpoints.clear();
        int tracked = 0;
        const std::pair<Index, Index> places[]{{frames - 1, 30}, {frames - 1, 5}, {4200, 40}};
        for (const auto &[frame, cell] : places) {
            const double seconds = analysis->time().value(double(frame));
            const double hz = analysis->grid().axes[0].value(double(cell));
            const Explanation with = explain(*analysis, seconds, {hz});
            const Explanation without = explain(withoutAny, seconds, {hz});
            QCOMPARE(with.statistic, without.statistic);
            QCOMPARE(with.displayed, without.displayed);
            QCOMPARE(with.isTracked, without.isTracked);
            QCOMPARE(with.inhibitedFor, without.inhibitedFor);
            QCOMPARE(with.otherState, without.otherState);
            QCOMPARE(with.otherMargin, without.otherMargin);
            QCOMPARE(with.reset.kind, without.reset.kind);
            QCOMPARE(with.reset.lost, without.reset.lost);
            QCOMPARE(with.steps.size(), without.steps.size());
            for (std::size_t i = 0; i < with.steps.size(); ++i) {
                QCOMPARE(with.steps[i].frame, without.steps[i].frame);
                QCOMPARE(with.steps[i].state, without.steps[i].state);
                QCOMPARE(with.steps[i].score, without.steps[i].score);
                QCOMPARE(with.steps[i].runnerUp, without.steps[i].runnerUp);
            }
            tracked += with.isTracked;
        }
        QCOMPARE(tracked, 1);
    }
};

FAINTLINE_TEST(tst_explainLines)
#include "tst_explainLines.moc"
