#include "analyse/analyse.h"
#include "inspect/StateReplay.h"
#include "support/test.h"

#include "base/Random.h"
#include "plan/chain.h"
#include "scene/SimulatedPings.h"
#include "support/frames.h"
#include "support/pings.h"

#include <algorithm>
#include <limits>
#include <map>

using namespace faintline;

namespace {

AnalysisSettings settings(Motion motion = Motion::Slopes)
{
    AnalysisSettings s = preset("sonar").settings;
    s.model.motion = motion;
    s.model.lowestSlope = -1;
    s.model.highestSlope = 1;
    s.decide.thresholdNats = 20.0;
    s.decide.inhibitCells = {2.0, 1.0};
    s.decide.forgetCells = {4.0, 1.0};
    s.track.windowCells = {4.0, 1.0};
    return s;
}

PingScene scene()
{
    return test::recedingTarget(16, 60, 3200.0);
}

struct Run {
    std::shared_ptr<const Analysis> analysis;
    std::vector<std::vector<float>> statistic; ///< of each ping
};

const Run &run()
{
    static const Run result = [] {
        Run made;
        const auto frames = std::make_shared<SimulatedPings>(scene());
        const auto cells = std::size_t(frames->grid().size());
        const StatisticSink keep = [&](Index, std::span<const float> values) {
            for (std::size_t i = 0; i < values.size(); i += cells)
                made.statistic.emplace_back(values.begin() + std::ptrdiff_t(i),
                                            values.begin() + std::ptrdiff_t(i + cells));
        };
        made.analysis = analyse(frames, settings(), {.statistic = keep});
        return made;
    }();
    return result;
}

/// Largest value over the rates, cell by cell.
std::vector<float> projected(const StateScores &states, Index cells)
{
    std::vector<float> best(std::size_t(cells), -std::numeric_limits<float>::infinity());
    for (std::size_t i = 0; i < states.values.size(); ++i)
        best[i % best.size()] = std::max(best[i % best.size()], states.values[i]);
    return best;
}

} // namespace

class tst_StateReplay : public QObject
{
    Q_OBJECT

private slots:
    void statesHaveTheStatisticThatWasShown()
    {
        const Analysis &analysis = *run().analysis;
        QVERIFY(!analysis.tracks.empty()); // so a tracker's window is among them
        StateReplay replay(run().analysis);
        for (const Index frame : {0, 3, 9, 15})
            QCOMPARE(projected(*replay.at(frame), analysis.grid().size()), run().statistic[std::size_t(frame)]);
    }

    void backAndForthIsTheSame()
    {
        StateReplay wide(run().analysis);
        StateReplay narrow(run().analysis, 1); // keeps one frame only
        std::map<Index, std::vector<float>> seen;
        for (const Index frame : {4, 7, 6, 12, 2, 7, 99, -5}) {
            const auto states = wide.at(frame);
            QCOMPARE(states->frame, std::clamp<Index>(frame, 0, 15));
            QCOMPARE(narrow.at(frame)->values, states->values);
            if (const auto before = seen.find(states->frame); before != seen.end())
                QCOMPARE(states->values, before->second);
            seen[states->frame] = states->values;
        }
    }

    void farBackGoesOnFromACheckpoint()
    {
        PingScene longer = scene();
        longer.pings = 60;
        longer.targets[0].vanishPing = 40;
        const auto frames = std::make_shared<SimulatedPings>(longer);
        for (const SmdSettings::Reset reset : {SmdSettings::Reset::Mean, SmdSettings::Reset::Half}) {
            AnalysisSettings chosen = settings();
            chosen.detector = SmdSettings{reset, 0.0};
            const auto analysis = analyse(frames, chosen);
            QVERIFY(!analysis->tracks.empty());
            constexpr std::size_t fewFrames = 4 * 60 * 6 * 9 * sizeof(float);
            StateReplay replay(analysis, 2 * fewFrames); // four checkpoints of scores alone, four frames
            QVERIFY2(replay.interval() == 15, qPrintable(QString::number(replay.interval())));
            std::map<Index, std::vector<float>> straight;
            StateReplay whole(analysis);
            for (Index frame = 0; frame < 60; ++frame)
                straight[frame] = whole.at(frame)->values;
            for (const Index frame : {59, 30, 14, 15, 16, 45, 44, 29, 52, 3}) {
                int steps = 0;
                RunContext context;
                context.progress = [&](double, std::string_view) { ++steps; };
                QCOMPARE(replay.at(frame, 0, context)->values, straight[frame]);
                if (frame != 59)
                    QVERIFY2(steps <= replay.interval(), qPrintable(QString::number(steps)));
            }
            QCOMPARE(replay.interval(), Index(30)); // with the windows of the tracks there is room for two
        }
    }

    void itBeginsWhereTheRunLeftACheckpoint()
    {
        constexpr Index frames = 400;
        constexpr Index cells = 48;
        std::vector<float> y(std::size_t(frames * cells));
        Random(8, 1).exponentials(y);
        for (Index frame = 50; frame < 300; ++frame)
            y[std::size_t(frame * cells + 20)] += 5.0f;
        AnalysisSettings chosen;
        chosen.detector = SmdSettings{SmdSettings::Reset::Fixed, 0.6};
        chosen.decide.by = DecideSettings::By::Nats;
        chosen.decide.thresholdNats = 14.0;
        const auto analysis = analyse(test::framesOf(cells, std::move(y), 0.25, 0.5), chosen);
        QCOMPARE(analysis->checkpoints.count(), std::size_t(6)); // every 64 frames
        QVERIFY(!analysis->tracks.empty());
        Analysis alone = *analysis;
        alone.checkpoints.clear();
        StateReplay straight(std::make_shared<const Analysis>(alone));
        StateReplay replay(analysis);
        for (const Index frame : {390, 200, 199, 130, 300, 10, 64, 63, 128, 391}) {
            int steps = 0;
            RunContext context;
            context.progress = [&](double, std::string_view) { ++steps; };
            QCOMPARE(replay.at(frame, 0, context)->values, straight.at(frame)->values);
            QVERIFY2(steps <= 64, qPrintable(QString::number(steps)));
        }
    }

    void aCancelledLookIsTakenUpAgain()
    {
        StateReplay replay(run().analysis);
        int calls = 0;
        std::stop_source stop;
        RunContext context;
        context.stop = stop.get_token();
        context.progress = [&](double, std::string_view) {
            if (++calls == 5)
                stop.request_stop();
        };
        QVERIFY_EXCEPTION_THROWN(replay.at(15, 0, context), Cancelled);
        QCOMPARE(projected(*replay.at(15), run().analysis->grid().size()), run().statistic[15]);
    }

    void aBanksMembersAreTheStatisticTogether()
    {
        PingScene small = scene();
        small.pings = 4;
        small.rangeCells = 12;
        small.beams = 4;
        small.targets.clear();
        const auto frames = std::make_shared<SimulatedPings>(small);
        Analysis analysis;
        analysis.settings = settings(Motion::Bank);
        analysis.settings.model.motion = Motion::Bank;
        analysis.frames = frames;
        auto calibration = std::make_shared<Calibration>();
        for (const MarkovModel &model : makeModels(analysis.settings.model, frames->grid()))
            analysis.bank.push_back({model, calibration, analysis.bank.empty() ? 0.0 : 1.5});
        analysis.model = analysis.bank.front().model;
        analysis.calibration = calibration;
        analysis.threshold = 1000.0;
        const auto shared = std::make_shared<const Analysis>(analysis);
        StateReplay replay(shared);
        const Index cells = frames->grid().size();
        const auto first = projected(*replay.at(3, 0), cells);
        const auto second = projected(*replay.at(3, 1), cells);
        const auto axes = stateAxes(*shared, 1);
        QCOMPARE(axes.size(), std::size_t(4));
        QCOMPARE(axes[2].name, std::string("range rate"));
        QCOMPARE(axes[2].step, 10.0 / 40.0);
        QVERIFY(first != second);
        QCOMPARE(replay.at(3, 1)->model, std::size_t(1));
        // The bank shows the larger of the two.
        const auto chain = makeChain(*shared);
        std::vector<float> y(first.size());
        std::vector<float> shown(first.size());
        for (Index ping = 0; ping <= 3; ++ping) {
            frames->read(ping, 1, y);
            chain->update(ping, y, shown);
        }
        for (std::size_t cell = 0; cell < shown.size(); ++cell)
            QCOMPARE(shown[cell], std::max(first[cell], second[cell]));
    }

    void slicesByEye()
    {
        // One axis of cells with two rates, another with three cells and one: scores 0 … 11 in the order of memory.
        const StateSpace space({{"a", 2, false, 0, 2, {0.5, 0.25}, {}}, {"b", 3, false, 0, 1, {1.0}, {}}});
        std::vector<float> scores(12);
        for (std::size_t i = 0; i < scores.size(); ++i)
            scores[i] = float(i);
        // (rate of a, rate of b, cell of a, cell of b)
        QCOMPARE(cutStates(space, scores, {0, 1, {{}, {}, 0, 0}}), (std::vector<float>{0, 1, 2, 3, 4, 5}));
        QCOMPARE(cutStates(space, scores, {0, 1, {{}, {}, {}, {}}}), (std::vector<float>{6, 7, 8, 9, 10, 11}));
        QCOMPARE(cutStates(space, scores, {1, 0, {{}, {}, 1, 0}}), (std::vector<float>{6, 9, 7, 10, 8, 11}));
        QCOMPARE(cutStates(space, scores, {1, 2, {0, {}, {}, 0}}), (std::vector<float>{0, 6, 1, 7, 2, 8}));
        QCOMPARE(cutStates(space, scores, {2, 0, {{}, 2, {}, 0}}), (std::vector<float>{2, 5, 8, 11}));
        QCOMPARE(bestRates(space, scores, 4), (std::vector<Index>{1, 0}));
        scores[10] = scores[4]; // equals: the lowest
        QCOMPARE(bestRates(space, scores, 4), (std::vector<Index>{0, 0}));
    }
};

FAINTLINE_TEST(tst_StateReplay)
#include "tst_StateReplay.moc"
