#include "analyse/analyse.h"
#include "evaluate/experiments/Campaign.h"
#include "evaluate/experiments/SweepTrials.h"
#include "evaluate/experiments/campaignCharts.h"
#include "evaluate/experiments/campaignCurve.h"
#include "exchange/CampaignFile.h"
#include "scene/SimulatedRecording.h"
#include "support/files.h"
#include "support/test.h"

#include "base/Error.h"
#include "support/errors.h"

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

/// A line that is there to be found, three thresholds.
Experiment sweep()
{
    Experiment sweep{.kind = Experiment::Kind::Sweep,
                     .trials = 6,
                     .snrDb = {4.0},
                     .durationSeconds = 15.0,
                     .marginSeconds = 8.0,
                     .sampleRateHz = 200.0};
    sweep.settings.spectrogram.windowSeconds = 0.5;
    sweep.settings.model.lowestSlope = sweep.settings.model.highestSlope = 0;
    sweep.settings.model.slopeChange = {1.0};
    sweep.parameter = "decide.thresholdNats";
    sweep.values = {3.0, 12.0, 400.0};
    return sweep;
}

Campaign carriedOut(const Experiment &sweep, int threads = 1)
{
    RunContext context;
    context.threads = threads;
    Campaign campaign{sweep, {}, {}};
    carryOut(campaign, runsOfShard(sweep, 0, 1), context);
    return campaign;
}

std::string whyNot(const Experiment &sweep)
{
    return test::errorOf([&] { checkExperiment(sweep); });
}

Experiment with(const std::string &parameter, const std::vector<double> &values)
{
    Experiment changed = sweep();
    changed.parameter = parameter;
    changed.values = values;
    return changed;
}

} // namespace

/// The values of one setting on the same lines, by the engine that all experiments share.
class tst_SweepTrials : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }

private slots:
    void valuesOfARange()
    {
        QCOMPARE(sweepValues("model.snr", 0.1, 0.5, 5, false), (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5}));
        QCOMPARE(sweepValues("model.snr", 0.25, 4.0, 5, true), (std::vector<double>{0.25, 0.5, 1.0, 2.0, 4.0}));
        QCOMPARE(sweepValues("model.slopesPerBin", 1, 3, 5, false),
                 (std::vector<double>{1, 2, 3})); // whole, without repeats
        QVERIFY_THROWS_EXCEPTION(Error, sweepValues("model.snr", 0.0, 1.0, 3, true));
        QVERIFY_THROWS_EXCEPTION(Error, sweepValues("detector.kind", 0.0, 1.0, 3, false));
    }

    void refusals_data()
    {
        QTest::addColumn<QString>("parameter");
        QTest::addColumn<double>("value");
        QTest::addColumn<QString>("why");
        QTest::newRow("unknown") << "model.snt" << 1.0 << "model.snt: unknown setting; did you mean model.snr";
        QTest::newRow("a choice") << "detector.kind" << 1.0
                                  << "parameter = detector.kind: must be a setting that is one number";
        QTest::newRow("another detector's") << "pOfN.n" << 4.0 << "parameter = pOfN.n: belongs to a different detector";
        QTest::newRow("out of range") << "spectrogram.windowSeconds" << -1.0
                                      << "spectrogram.windowSeconds = -1: must lie in 0";
        QTest::newRow("not of the line") << "trials" << 4.0
                                         << "parameter = trials: must be a setting that is one number";
        QTest::newRow("line out of range") << "durationSeconds" << 0.0 << "durationSeconds = 0: must lie in";
        QTest::newRow("not whole") << "model.slopesPerBin" << 1.5 << "model.slopesPerBin = 1.5: must be a whole number";
    }

    void refusals()
    {
        QFETCH(QString, parameter);
        QFETCH(double, value);
        QFETCH(QString, why);
        const QString told = QString::fromStdString(whyNot(with(parameter.toStdString(), {value})));
        QVERIFY2(told.startsWith(why), qPrintable(told));
    }

    void propertiesOfTheLineAreVaried()
    {
        Experiment changed = with("snrDb", {-30.0, 6.0});
        changed.settings.decide.thresholdNats = 12.0;
        changed.settings.decide.by = DecideSettings::By::Nats;
        QVERIFY(experimentFromJson(toJson(Experiment(changed)), "test") == Experiment(changed));
        QCOMPARE(experimentAt(changed, 1).snrDb, std::vector{6.0});
        QVERIFY(experimentAt(changed, 1).settings == changed.settings);
        const std::vector<SweepPoint> curve = sweepCurve(carriedOut(changed));
        QCOMPARE(curve[0].detections, 0);
        QCOMPARE(curve[1].detections, curve[1].trials);
        QCOMPARE(sweepChart(carriedOut(changed), SweepMeasure::Latency).xLabel, std::string("snrDb (dB)"));
    }

    void eachTrialChoosesAWindowThatIsNotSet()
    {
        Experiment open = with("snrDb", {12.0});
        open.settings = {};
        open.trials = 2;
        const SweepTrials trials(open, nullptr);
        const auto made = trials.remake(1);
        QCOMPARE(made.settings.spectrogram.windowSeconds, 0.0);
        const auto analysis = analyse(made.recording, made.settings);
        QVERIFY(analysis->choice);
        const RunOutcome outcome = trials.run({1}).front();
        QCOMPARE(double(outcome.noise[0][1]), double(analysis->time().count) * analysis->time().step);
        QVERIFY(outcome.signal[0][0][0] >= 0.0f);
    }

    void runsAreCounted()
    {
        Experiment large = sweep();
        large.trials = 1'000'000;
        large.values.assign(3000, 5.0);
        QCOMPARE(whyNot(large), std::string("trials = 1000000: times 3000 values gives more than 10 million trials"));
    }

    void jsonRoundTrip()
    {
        const Experiment before = sweep();
        const Experiment after = experimentFromJson(toJson(before), "test");
        QVERIFY(after == before);
        Json json = toJson(before);
        json["values"] = Json{{"from", 1.0}, {"to", 100.0}, {"steps", 3}, {"scale", "log"}};
        QCOMPARE(experimentFromJson(json, "test").values, (std::vector<double>{1.0, 10.0, 100.0}));
        json["values"]["scale"] = "square";
        QVERIFY_THROWS_EXCEPTION(Error, experimentFromJson(json, "test"));
        json["values"]["scale"] = 5;
        QVERIFY_THROWS_EXCEPTION(Error, experimentFromJson(json, "test"));
        json["values"]["scale"] = "log";
        json["recording"] = "";
        QVERIFY_THROWS_EXCEPTION(Error, experimentFromJson(json, "test"));
        json.erase("values");
        QVERIFY_THROWS_EXCEPTION(Error, experimentFromJson(json, "test"));
    }

    void runsGoRoundTheValues()
    {
        const Experiment experiment = sweep();
        QCOMPARE(experiment.runs(), 18);
        QCOMPARE(experiment.valueOf(7), 1);
        QCOMPARE(experiment.trialOf(7), 2);
        // The same trial for every value: the same samples, the same line.
        const SweepTrials trials(experiment, nullptr);
        const auto a = trials.remake(6), b = trials.remake(8), c = trials.remake(9);
        QVERIFY(a.truth == b.truth);
        QVERIFY(!(a.truth == c.truth));
        QCOMPARE(a.settings.decide.thresholdNats, 3.0);
        QCOMPARE(b.settings.decide.thresholdNats, 400.0);
        std::vector<float> x(100), y(100);
        a.recording->read(0, 0, 100, x);
        b.recording->read(0, 0, 100, y);
        QCOMPARE(x, y);
    }

    void thresholdsTradeDetectionsForFalseAlarms()
    {
        const Campaign campaign = carriedOut(sweep());
        QCOMPARE(campaign.thresholds, (std::vector<double>{3.0, 12.0, 400.0}));
        const std::vector<SweepPoint> curve = sweepCurve(campaign);
        QCOMPARE(curve.size(), std::size_t(3));
        QCOMPARE(curve[1].pd, 1.0);
        QCOMPARE(curve[2].pd, 0.0);
        QCOMPARE(curve[2].falseAlarms, std::int64_t(0));
        QVERIFY(curve[0].falseAlarms > curve[1].falseAlarms);
        QVERIFY(curve[1].latencySeconds > 0.0 && curve[1].latencySeconds < 10.0);
        QVERIFY(std::abs(curve[0].hours - 6.0 * 30.75 / 3600.0) < 1e-9); // 31 s are 123 frames of a quarter of a second
        QVERIFY(curve[1].pdInterval == wilsonInterval(6, 6));

        QCOMPARE(tradeOffChart(campaign).curves.front().points.size(), std::size_t(3));
        QCOMPARE(tradeOffChart(campaign).curves.front().points[1].label, std::string("12"));
        QCOMPARE(sweepChart(campaign, SweepMeasure::Latency).curves.front().points.size(),
                 std::size_t(2)); // never is no latency
        QCOMPARE(pdCurve(campaign)[1].detector, std::string("decide.thresholdNats = 12"));
    }

    void countsByHand()
    {
        Experiment experiment = sweep();
        experiment.values = {10.0, 20.0};
        experiment.trials = 2;
        const double never = -INFINITY;
        Campaign campaign{experiment, {10.0, 20.0}, {}};
        campaign.outcomes = {sweepOutcome(0, 3, 1800.0, 2.0), sweepOutcome(1, 0, 1800.0, never),
                             sweepOutcome(2, 1, 1800.0, 4.0), sweepOutcome(3, 0, 1800.0, 6.0)};
        const std::vector<SweepPoint> curve = sweepCurve(campaign);
        QCOMPARE(curve[0].pd, 1.0);
        QCOMPARE(curve[0].falseAlarmsPerHour, 4.0);
        QCOMPARE(curve[0].latencySeconds, 3.0);
        QVERIFY(curve[0].latencyInterval == normalInterval(3.0, 1.0)); // deviation √2 of two
        QCOMPARE(curve[1].pd, 0.5);
        QCOMPARE(curve[1].latencySeconds, 6.0);
        QVERIFY(curve[1].falseAlarmInterval == poissonInterval(0));
    }

    void shardsAndThreadsChangeNoByte()
    {
        const Experiment experiment = sweep();
        const Campaign whole = carriedOut(experiment);
        QVERIFY(carriedOut(experiment, 4).outcomes == whole.outcomes);
        std::vector<Campaign> parts;
        for (int i = 0; i < 4; ++i) {
            Campaign part{experiment, {}, {}};
            carryOut(part, runsOfShard(experiment, i, 4));
            const std::string file = path(("part" + std::to_string(i)).c_str());
            writeCampaign(part, file);
            parts.push_back(readCampaign(file)); // through the file: never is null there
        }
        const Campaign merged = merge(std::move(parts));
        QVERIFY(merged.outcomes == whole.outcomes);
        writeCurve(whole, path("whole.csv"));
        writeCurve(merged, path("merged.csv"));
        QVERIFY(readBytes(path("whole.csv")) == readBytes(path("merged.csv")));
        QVERIFY(readBytes(path("whole.csv")).startsWith("parameter,value,pd,"));
        QCOMPARE(readBytes(path("whole.csv")).count('\n'), 4);
    }

    void goesOnAfterAnInterruption()
    {
        const Experiment experiment = sweep();
        const Campaign whole = carriedOut(experiment);
        Campaign half{experiment, whole.thresholds, {whole.outcomes.begin(), whole.outcomes.begin() + 7}};
        writeCampaign(half, path("sweep.csv") + ".part");
        const Campaign resumed = carryOutResumably(experiment, runsOfShard(experiment, 0, 1), path("sweep.csv"));
        QVERIFY(resumed.outcomes == whole.outcomes);
    }

    void windowsOfOtherLengths()
    {
        // The line and its SNR stay the same; the frames do not.
        const Experiment experiment = with("spectrogram.windowSeconds", {0.25, 1.0});
        const SweepTrials trials(experiment, nullptr);
        QVERIFY(trials.remake(0).truth == trials.remake(1).truth);
        const auto outcomes = trials.run({0, 1});
        QVERIFY(outcomes[0].noise[0][1] > 30.0f && outcomes[1].noise[0][1] > 30.0f);
    }

    void inARecordingsNoise()
    {
        LineScene scene{.sampleRateHz = 200.0, .durationSeconds = 200.0};
        const auto recording = std::make_shared<SimulatedRecording>(scene);
        Experiment experiment = sweep();
        experiment.recording = "anything";
        experiment.values = {12.0};
        const SweepTrials trials(experiment, recording);
        const auto made = trials.remake(3);
        QVERIFY(made.settings.selection.fromSeconds > 0.0);
        QVERIFY(std::abs(made.settings.selection.toSeconds - made.settings.selection.fromSeconds - 31.0) < 1e-9);
        QVERIFY(std::abs(made.truth.startSeconds - made.settings.selection.fromSeconds - 8.0) < 0.01);
        int detected = 0;
        for (const RunOutcome &outcome : trials.run({0, 1, 2, 3}))
            detected += outcome.signal[0][0][0] >= 0.0f ? 1 : 0;
        QCOMPARE(detected, 4);
        experiment.marginSeconds = 100.0;
        QVERIFY_THROWS_EXCEPTION(Error, SweepTrials(experiment, recording));
    }
};

FAINTLINE_TEST(tst_SweepTrials)
#include "tst_SweepTrials.moc"
