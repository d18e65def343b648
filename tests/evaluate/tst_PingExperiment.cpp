#include "evaluate/experiments/PingExperiment.h"
#include "support/test.h"

#include "support/errors.h"

using namespace faintline;
using namespace faintline::test;

namespace {

/// A small field with one strong target that keeps its rates from the fifth ping on.
PingExperiment experiment()
{
    PingExperiment made;
    made.scene.pings = 40;
    made.scene.rangeCells = 150;
    made.scene.beams = 12;
    PingTarget target{.snrDb = 14.0,
                      .rangeMetres = 3400.0,
                      .bearingDegrees = 60.0,
                      .appearPing = 5,
                      .legs = {{0, 0.0, 0.0, 1.0, 0.0, 1}}};
    made.scene.targets = {target};
    made.settings = preset("sonarSteady").settings;
    made.runs = 4;
    made.settlingPings = 60;
    made.seed = 9;
    return made;
}

bool areSame(const std::vector<TrackScore> &a, const std::vector<TrackScore> &b)
{
    if (a.size() != b.size())
        return false;
    for (std::size_t run = 0; run < a.size(); ++run) {
        if (a[run].falseTracks != b[run].falseTracks || a[run].targetOfTrack != b[run].targetOfTrack)
            return false;
        for (std::size_t i = 0; i < a[run].targets.size(); ++i)
            if (a[run].targets[i].detectLatency != b[run].targets[i].detectLatency
                || a[run].targets[i].rmsCells != b[run].targets[i].rmsCells)
                return false;
    }
    return true;
}

} // namespace

/// The whole chain on simulated pings: what it finds, what a run depends on, what it refuses.
class tst_PingExperiment : public QObject
{
    Q_OBJECT

private slots:
    void aStrongTargetIsFoundInEveryRun()
    {
        const std::vector<TrackScore> scores = runPings(experiment());
        QCOMPARE(scores.size(), std::size_t(4));
        for (const TrackScore &score : scores) {
            QCOMPARE(score.targets.size(), std::size_t(1));
            const TargetScore &target = score.targets.front();
            QCOMPARE(target.presentPings, Index(35));
            QVERIFY(target.isDetected() && target.detectLatency <= 5);
            QVERIFY(target.isConfirmed() && target.confirmLatency >= target.detectLatency);
            QVERIFY(target.matchedPoints >= 25);
            QVERIFY(target.rmsCells[0] < 1.5 && target.rmsCells[1] < 1.0);
        }
    }

    void withoutATargetThereIsNone()
    {
        PingExperiment made = experiment();
        made.scene.targets.clear();
        for (const TrackScore &score : runPings(made)) {
            QVERIFY(score.targets.empty());
            QCOMPARE(score.falseConfirmed, 0);
            QCOMPARE(score.falseTracks, int(score.targetOfTrack.size()));
        }
    }

    void aRunDependsOnItsNumberAlone()
    {
        PingExperiment made = experiment();
        made.scene.targets.front().snrDb = 4.0; // so that latencies differ
        const std::vector<TrackScore> scores = runPings(made);
        RunContext three;
        three.threads = 3;
        QVERIFY(areSame(runPings(made, three), scores));
        made.runs = 2;
        const std::vector<TrackScore> two = runPings(made);
        QVERIFY(areSame(two, {scores[0], scores[1]}));
        QVERIFY(!areSame({scores[0]}, {scores[1]}));
    }

    void seedsMatter()
    {
        PingExperiment made = experiment();
        made.scene.targets.front().snrDb = 4.0;
        const std::vector<TrackScore> scores = runPings(made);
        made.scene.seed = 77; // the scene's own is not looked at
        QVERIFY(areSame(runPings(made), scores));
        made.seed = 10;
        QVERIFY(!areSame(runPings(made), scores));
    }

    void noRunsNoScores()
    {
        PingExperiment made = experiment();
        made.runs = 0;
        QVERIFY(runPings(made).empty());
    }

    void otherDetectorsAreRefused()
    {
        const std::string words =
            "experiment: requires the sequential Markov detector with one model; choose detector.kind = smd";
        PingExperiment made = experiment();
        made.settings.detector = EnergySettings{};
        QCOMPARE(errorOf([&] { runPings(made); }), words);
        made = experiment();
        made.settings.model.motion = Motion::Bank;
        QCOMPARE(errorOf([&] { runPings(made); }), words);
    }

    void cancels()
    {
        std::stop_source source;
        RunContext context;
        context.stop = source.get_token();
        double latest = 0.0;
        context.progress = [&](double fraction, std::string_view what) {
            QVERIFY(fraction >= latest && fraction <= 1.0);
            latest = fraction;
            if (what == "following targets")
                source.request_stop();
        };
        QVERIFY_THROWS_EXCEPTION(Cancelled, runPings(experiment(), context));
        QVERIFY(latest >= 0.2); // settled first
        QVERIFY_THROWS_EXCEPTION(Cancelled, runPings(experiment(), context));
    }
};

FAINTLINE_TEST(tst_PingExperiment)
#include "tst_PingExperiment.moc"
