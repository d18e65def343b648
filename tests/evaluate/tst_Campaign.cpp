#include "analyse/analyse.h"
#include "base/Error.h"
#include "base/Random.h"
#include "base/files/AtomicFile.h"
#include "evaluate/experiments/Campaign.h"
#include "evaluate/experiments/InjectionTrials.h"
#include "evaluate/experiments/LineTrials.h"
#include "evaluate/experiments/campaignCurve.h"
#include "evaluate/experiments/lineDetection.h"
#include "evaluate/experiments/showTrial.h"
#include "exchange/CampaignFile.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "signal/openRecording.h"
#include "support/errors.h"
#include "support/test.h"

#include <cmath>
#include <limits>
#include <numeric>

using namespace faintline;

namespace {

DetectorUnderTest detectorUnderTest(const char *name, const DetectorSettings &detector)
{
    DetectorUnderTest result{name, {}};
    result.settings.model = laws::billon(); // the law of ln K = 0.69
    result.settings.detector = detector;
    return result;
}

Experiment smallExperiment()
{
    Experiment experiment{
        .trials = 6, .frames = 120, .blockFrames = 60, .snrDb = {-3.0, 3.0}, .durationSeconds = 20.0, .wanderHz = 0.5};
    experiment.detectors = {
        detectorUnderTest("SMD", SmdSettings{SmdSettings::Reset::Fixed, 0.69}),
        detectorUnderTest("3 of 4", PofNSettings{3, 4}),
        detectorUnderTest("integrator", IntegratorSettings{IntegratorSettings::Shape::Boxcar, 20.0})};
    return experiment;
}

std::vector<int> firstRuns(int count)
{
    std::vector<int> runs(static_cast<std::size_t>(count));
    std::iota(runs.begin(), runs.end(), 0);
    return runs;
}

RunContext onThreads(int threads)
{
    RunContext context;
    context.threads = threads;
    return context;
}

} // namespace

class tst_Campaign : public QObject
{
    Q_OBJECT

private slots:
    void threadsAndOrderChangeNothing()
    {
        const Experiment experiment = smallExperiment();
        const auto one = LineTrials(experiment).run({0, 1, 2, 3}, onThreads(1));
        QVERIFY(LineTrials(experiment).run({0, 1, 2, 3}, onThreads(3)) == one);
        const auto other = LineTrials(experiment).run({3, 1}, onThreads(2));
        QVERIFY(other[0] == one[3] && other[1] == one[1]);
        QVERIFY(!(one[0].signal == one[1].signal));
    }

    void shardsMergeToTheWhole()
    {
        const Experiment experiment = smallExperiment();
        Campaign whole{experiment, {}, {}};
        carryOut(whole, firstRuns(6));
        writeCurve(whole, path("whole.csv"));
        std::vector<Campaign> parts;
        for (const int shard : {2, 0, 1}) {
            Campaign part{experiment, {}, {}};
            carryOut(part, runsOfShard(experiment, shard, 3));
            writeCampaign(part, path("shard"));
            parts.push_back(readCampaign(path("shard")));
        }
        writeCurve(merge(parts), path("merged.csv"));
        QFile a(m_folder.filePath("whole.csv"));
        QFile b(m_folder.filePath("merged.csv"));
        QVERIFY(a.open(QFile::ReadOnly) && b.open(QFile::ReadOnly));
        const QByteArray bytes = a.readAll();
        QCOMPARE(bytes.count('\n'), 1 + 3 * 2);
        QCOMPARE(b.readAll(), bytes);

        parts.pop_back();
        QVERIFY_EXCEPTION_THROWN(merge(parts), Error);          // a shard is missing
        QVERIFY_EXCEPTION_THROWN(merge({whole, whole}), Error); // twice the same
        Campaign foreign = whole;
        foreign.experiment.seed = 99;
        QVERIFY_EXCEPTION_THROWN(merge({whole, foreign}), Error);
    }

    void namesOfDetectorsInACurve()
    {
        Experiment experiment = smallExperiment();
        experiment.detectors = {detectorUnderTest("a\",9\n\"b\",1,1,1,1,1,1", PofNSettings{3, 4})};
        Campaign campaign{experiment, {}, {}};
        carryOut(campaign, firstRuns(1));
        writeCurve(campaign, path("names.csv"));
        const std::vector<CurvePoint> curve = readCurve(path("names.csv"));
        QCOMPARE(curve.size(), 2u); // one for each SNR, and no row that a name brought with it
        QCOMPARE(curve[1].detector, std::string("a\",9 \"b\",1,1,1,1,1,1"));
        QCOMPARE(curve[1].snrDb, 3.0);

        QFile file(m_folder.filePath("names.csv"));
        QVERIFY(file.open(QFile::Append) && file.write("\"c\",3,0.5,0,1,1e300,\n") > 0);
        file.close();
        QVERIFY_EXCEPTION_THROWN(readCurve(path("names.csv")), Error); // nobody tries so often
    }

    void killedAndResumed()
    {
        const Experiment experiment = smallExperiment();
        const std::string out = path("resumed");
        const Campaign whole = carryOutResumably(experiment, firstRuns(6), path("undisturbed"));
        // Killed in the middle of the third line.
        const Campaign some = carryOutResumably(experiment, {0, 1, 2}, out);
        QFile parts(QString::fromStdString(out + ".part"));
        QVERIFY(parts.open(QFile::ReadWrite));
        QVERIFY(parts.resize(parts.size() - 40));
        parts.close();
        QCOMPARE(readCampaign(out + ".part").outcomes.size(), std::size_t(2));
        const Campaign resumed = carryOutResumably(experiment, firstRuns(6), out);
        QVERIFY(resumed.outcomes == whole.outcomes);
        QVERIFY(readCampaign(out + ".part").outcomes.size() == 6);
        Experiment other = experiment;
        other.seed = 2;
        QVERIFY_EXCEPTION_THROWN(carryOutResumably(other, {0}, out), Error);
        removeParts(out);
        QVERIFY(!QFile::exists(QString::fromStdString(out + ".part")));
    }

    void changedPartsAreMadeAgain()
    {
        const Experiment experiment = smallExperiment();
        const std::string out = path("changed");
        const Campaign whole = carryOutResumably(experiment, firstRuns(3), out);
        const QString parts = QString::fromStdString(out + ".part");
        const auto change = [&](int line, const QByteArray &before, const QByteArray &after) {
            QFile file(parts);
            if (!file.open(QFile::ReadOnly))
                return false;
            QList<QByteArray> lines = file.readAll().split('\n');
            file.close();
            const QByteArray old = lines[line];
            lines[line].replace(lines[line].lastIndexOf(before), before.size(), after);
            writeTextFile(out + ".part", lines.join('\n').toStdString());
            return old != lines[line];
        };
        QVERIFY(change(2, "\"signal\":[[[", "\"signal\":[[[9")); // a run that found more than it did
        QVERIFY(carryOutResumably(experiment, firstRuns(3), out).outcomes == whole.outcomes);
        QVERIFY(change(0, "\"thresholds\":[", "\"thresholds\":[1,"));
        const Campaign again = carryOutResumably(experiment, firstRuns(3), out);
        QVERIFY(again.outcomes == whole.outcomes && again.thresholds == whole.thresholds);
    }

    void everyTrialCanBeMadeAgain()
    {
        Experiment experiment = smallExperiment();
        experiment.wanderHz = 0.0;
        experiment.detectors = {detectorUnderTest("energy", EnergySettings{})};
        const RunOutcome outcome = LineTrials(experiment).run({2}).front();
        for (const int signal : {0, 3, experiment.signalsPerRun() - 1}) {
            const LineTrial trial = remakeTrial(experiment, experiment.snrDb[1], 2, signal);
            std::vector<float> y(std::size_t(trial.frames->grid().size()));
            float largest = 0.0f;
            for (std::size_t k = 0; k < trial.path.size(); ++k) {
                trial.frames->read(trial.firstFrame + Index(k), 1, y);
                largest = std::max(largest, y[std::size_t(trial.path[k])]);
            }
            QCOMPARE(largest, outcome.signal[0][1][std::size_t(signal)]);
        }
    }

    void billonsEstimateByHand()
    {
        Experiment experiment;
        experiment.snrDb = {0.0};
        RunOutcome outcome;
        outcome.noise = {{1.0f, 2.0f, 3.0f}};
        outcome.signal = {{{2.0f, 2.5f, 9.0f}}}; // exceeds 1, 2 and 3 of the blocks: 2 is not above 2
        const std::vector<RunOutcome> outcomes{outcome};
        const CurvePoint point = pdAgainstBlocks(experiment, outcomes, 0, 0);
        QVERIFY(std::abs(point.pd - 6.0 / 9.0) < 1e-15);
        QCOMPARE(point.trials, 3);
        QVERIFY(point.interval.contains(point.pd));
    }

    void thresholdsAndRoc()
    {
        Experiment experiment;
        experiment.snrDb = {0.0};
        RunOutcome outcome;
        outcome.noise = {{4.0f, 1.0f, 3.0f, 2.0f}};
        outcome.signal = {{{0.5f, 2.5f, 3.5f, 9.0f}}};
        const std::vector<RunOutcome> outcomes{outcome};
        QCOMPARE(blockThreshold(outcomes, 0, 0.25), 3.0); // one block of four exceeds it
        const auto roc = rocPoints({experiment, {}, outcomes}, 0, 0);
        QCOMPARE(roc.size(), std::size_t(4));
        QCOMPARE(roc[0].threshold, 4.0);
        QCOMPARE(roc[0].falseAlarms, 0.0);
        QCOMPARE(roc[0].pd, 0.25);
        QVERIFY(std::abs(roc[2].falseAlarms - std::log(2.0)) < 1e-15);
        QCOMPARE(roc[2].pd, 0.75);
    }

    void strongLinesAreFoundAndAbsentOnesNot()
    {
        Experiment experiment = smallExperiment();
        experiment.snrDb = {-40.0, 15.0};
        Campaign campaign{experiment, {}, {}};
        carryOut(campaign, {0, 1, 2}, onThreads(2));
        const auto curve = pdCurve(campaign);
        QCOMPARE(curve.size(), std::size_t(6));
        for (const CurvePoint &point : curve)
            QVERIFY2(point.snrDb > 0.0 ? point.pd > 0.95 : point.pd < 0.2, point.detector.c_str());
    }

    void jsonRoundTrip()
    {
        const Experiment lines = smallExperiment();
        QVERIFY(experimentFromJson(toJson(lines), "test") == lines);
        Experiment injection = Experiment::of(Experiment::Kind::Injection);
        injection.recording = "a.wav";
        injection.settings.spectrogram.windowSeconds = 0.5;
        injection.detectors = {detectorUnderTest("SMD", SmdSettings{})};
        injection.detectors.push_back({"detect", {}, true});
        injection.wanderHz = 0.1;
        QVERIFY(experimentFromJson(toJson(Experiment(injection)), "test") == Experiment(injection));
    }

    void injectedIntoARecording()
    {
        Experiment injection = injectionIntoNoise();
        injection.trials = 6;
        injection.settings.spectrogram.windowSeconds = 0.5;
        injection.detectors = {detectorUnderTest("energy", EnergySettings{}),
                               detectorUnderTest("3 of 4", PofNSettings{3, 4})};
        Campaign campaign{injection, {}, {}};
        carryOut(campaign, firstRuns(6), onThreads(2));
        QCOMPARE(campaign.thresholds.size(), std::size_t(2));
        for (const CurvePoint &point : pdCurve(campaign)) {
            QCOMPARE(point.trials, 6);
            QCOMPARE(point.pd, point.snrDb > 0.0 ? 1.0 : 0.0);
        }
        Campaign again{injection, {}, {}};
        carryOut(again, {5, 2}, onThreads(1));
        QVERIFY(again.outcomes[0] == campaign.outcomes[2] && again.outcomes[1] == campaign.outcomes[5]);
    }

    void detectItselfInSimulatedNoise()
    {
        Experiment experiment = smallExperiment();
        experiment.frames = 240;
        experiment.snrDb = {-40.0, 10.0};
        experiment.detectors = {{"detect", {}, true}};
        Campaign campaign{experiment, {}, {}};
        carryOut(campaign, {0, 1}, onThreads(2));
        const std::vector<CurvePoint> curve = pdCurve(campaign);
        QVERIFY2(curve[0].pd < 0.1, qPrintable(QString::number(curve[0].pd)));
        QVERIFY2(curve[1].pd > 0.9, qPrintable(QString::number(curve[1].pd)));
        const std::vector<TrialOutcome> trials = trialsOf(campaign, {0, 1});
        for (const TrialOutcome &trial : {trials.front(), trials.back()}) {
            const ShownTrial shown = showTrial(campaign, nullptr, {0, 1}, trial.place);
            const LineDetection found = lineDetection(*shown.analysis, shown.truth.lines.front());
            QCOMPARE(float(found.margin), float(trial.statistic));
            QCOMPARE(trial.isDetected, found.margin > 0.0);
        }
    }

    // P of N decides by a mean power, whose unit is not that of its tracks' paths.
    void marginsAreInTheDetectorsUnit()
    {
        Experiment experiment = smallExperiment();
        experiment.frames = 240;
        experiment.snrDb = {10.0};
        experiment.detectors = {detectorUnderTest("3 of 4", PofNSettings{3, 4})};
        experiment.detectors.front().isWhole = true;
        const MadeTrial trial = remakeField(experiment, 10.0, 0, 0);
        const auto analysis = analyse(trial.recording, wholeSettings(experiment, 0));
        const LineDetection found = lineDetection(*analysis, trial.truth);
        double nearest = std::numeric_limits<double>::infinity();
        for (const Event &event : events(*analysis))
            nearest = std::min(nearest, std::abs(event.statistic - analysis->threshold - found.margin));
        QCOMPARE(nearest, 0.0);
    }

    // The mean number per block, from the blocks without any.
    void detectItselfIsOrderedOneFalseAlarmPerBlock()
    {
        Experiment experiment = smallExperiment();
        experiment.frames = 1200;
        experiment.snrDb = {-40.0};
        experiment.detectors = {{"detect", {}, true}};
        Campaign campaign{experiment, {}, {}};
        carryOut(campaign, firstRuns(6), onThreads(2));
        double blocks = 0.0;
        double hit = 0.0;
        for (const RunOutcome &outcome : campaign.outcomes)
            for (const float margin : outcome.noise[0]) {
                blocks += 1.0;
                hit += margin > 0.0f ? 1.0 : 0.0;
            }
        const double perBlock = -std::log1p(-hit / blocks);
        QVERIFY2(perBlock > 0.3 && perBlock < 2.0, qPrintable(QString("%1 of %2 blocks").arg(hit).arg(blocks)));
    }

    void detectItselfInARecording()
    {
        Experiment injection = injectionIntoNoise();
        injection.trials = 4;
        injection.marginSeconds = 30.0;
        injection.detectors = {detectorUnderTest("energy", EnergySettings{}), {"detect", {}, true}};
        Campaign campaign{injection, {}, {}};
        carryOut(campaign, firstRuns(4), onThreads(2));
        QCOMPARE(campaign.thresholds[1], 0.0);
        for (const CurvePoint &point : pdCurve(campaign))
            QCOMPARE(point.pd, point.snrDb > 0.0 ? 1.0 : 0.0);
        const InjectionTrials trials(injection, openRecording(injection.recording));
        const ShownTrial shown = showTrial(campaign, &trials, {1, 1}, {2, 0});
        QVERIFY(shown.analysis->choice);
        const TruthLine &line = shown.truth.lines.front();
        QCOMPARE(float(lineDetection(*shown.analysis, line).margin), campaign.outcomes[2].signal[1][1][0]);
        const SelectionSettings selection = shown.analysis->settings.selection;
        QCOMPARE(selection.fromSeconds, std::max(0.0, line.startSeconds - 30.0));
        QCOMPARE(selection.toSeconds, std::min(240.0, line.endSeconds + 30.0));
    }

    void allDetectorsAreTriedWhereNoSignalIs()
    {
        // A strong steady tone in half of the band's middle: it must neither count as a detection nor hide one.
        LineScene scene{.sampleRateHz = 200.0, .durationSeconds = 200.0};
        LineSettings tone{.snrDb = 25.0, .referenceSeconds = 0.5, .frequencyHz = 50.0};
        scene.lines = {tone};
        writeRecording(SimulatedRecording(scene), path("tone.wav"), WrittenType::Float32);
        Experiment injection = Experiment::of(Experiment::Kind::Injection);
        injection.recording = path("tone.wav");
        injection.trials = 12;
        injection.snrDb = {-30.0, 15.0};
        injection.durationSeconds = 20.0;
        injection.settings.spectrogram.windowSeconds = 0.5;
        injection.detectors = {detectorUnderTest("energy", EnergySettings{}),
                               detectorUnderTest("3 of 4", PofNSettings{3, 4}),
                               detectorUnderTest("SMD", SmdSettings{})};
        Campaign campaign{injection, {}, {}};
        carryOut(campaign, firstRuns(12), onThreads(2));
        const InjectionTrials trials(injection, openRecording(injection.recording));
        for (int trial = 0; trial < 12; ++trial)
            for (const double hz : trials.remake(trial, 0.0).truth.frequencyHz)
                QVERIFY2(std::abs(hz - 50.0) > 4.0, qPrintable(QString("trial %1 at %2 Hz").arg(trial).arg(hz)));
        for (const CurvePoint &point : pdCurve(campaign)) {
            QCOMPARE(point.trials, 12);
            QVERIFY2(point.snrDb > 0.0 ? point.pd > 0.9 : point.pd < 0.1,
                     qPrintable(QString::fromStdString(point.detector)));
        }
    }

    void thresholdsAreOfFalseAlarmsCounted()
    {
        Random random(3, 0);
        std::vector<float> maxima(2000);
        random.exponentials(maxima);
        std::vector<float> inOtherUnits = maxima;
        for (float &value : inOtherUnits)
            value = 1.0f + 0.01f * value;
        Calibration calibration;
        calibration.eventRate = 1e-3;
        const auto counted = [](const std::vector<float> &values, double threshold) {
            const auto n =
                std::count_if(values.begin(), values.end(), [&](float value) { return double(value) > threshold; });
            return -double(values.size()) * std::log1p(-double(n) / double(values.size()));
        };
        // The calibration, wrong for both, does not matter where there is enough to count.
        for (const double wanted : {12.0, 100.0}) {
            QVERIFY(std::abs(counted(maxima, measuredThreshold(maxima, wanted, calibration, 1e-6)) - wanted) < 0.6);
            QVERIFY(std::abs(counted(inOtherUnits, measuredThreshold(inOtherUnits, wanted, calibration, 1e-6)) - wanted)
                    < 0.6);
        }
        // One of them is ten, moved on by its slope.
        QVERIFY(std::abs(measuredThreshold(maxima, 1.0, calibration, 1e-6)
                         - measuredThreshold(maxima, 10.0, calibration, 1e-5) - std::log(10.0))
                < 1e-9);
        const std::vector<float> undecided(2000, -std::numeric_limits<float>::infinity());
        QCOMPARE(measuredThreshold(undecided, 1.0, calibration, 1e-6), calibration.thresholdForEventRate(1e-6));
    }

    void signalsAreMasked()
    {
        SignalMask mask(3, 10);
        mask.add(1, 2, 3);
        mask.add(1, 7, 12);
        mask.add(1, 3, 5);
        mask.add(5, 0, 9);
        std::vector<float> y(6, 1.0f);
        mask.blank(1, 4, y); // bins 4 … 9
        QCOMPARE(y, (std::vector<float>{0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f}));
        QVERIFY(mask.touches(1, 5, 6) && !mask.touches(1, 6, 6) && !mask.touches(1, -3, 1) && !mask.touches(0, 0, 9)
                && !mask.touches(7, 0, 9));
        QVERIFY(std::abs(mask.freeShare() - 23.0 / 30.0) < 1e-12);
    }

    void aBlockThatEndsAfterItsLineCounts()
    {
        // A line as long as a block has half of itself at least in one of two, and the second one ends after it.
        Experiment experiment{.trials = 3,
                              .frames = 600,
                              .snrDb = {6.0},
                              .durationSeconds = 40.0,
                              .detectors = {detectorUnderTest("block Viterbi", BlockViterbiSettings{40.0})}};
        Campaign campaign{experiment, {}, {}};
        carryOut(campaign, firstRuns(3), onThreads(2));
        for (const RunOutcome &outcome : campaign.outcomes)
            for (const float largest : outcome.signal[0][0])
                QVERIFY(std::isfinite(largest));
        // Read while the line lasts alone, those whose block ends early in it would be lost.
        QVERIFY2(pdCurve(campaign).front().pd > 0.75, qPrintable(QString::number(pdCurve(campaign).front().pd)));
    }

    void refusals_data()
    {
        QTest::addColumn<QByteArray>("json");
        QTest::addColumn<QByteArray>("names");
        QTest::newRow("kind") << QByteArray(R"({"kind": "sonar"})") << QByteArray("kind");
        QTest::newRow("no detector") << QByteArray(R"({"snrDb": [0]})") << QByteArray("detectors");
        QTest::newRow("unknown key") << QByteArray(R"({"snr": [0], "detectors": [{"name": "a"}]})")
                                     << QByteArray("snr");
        QTest::newRow("no SNR") << QByteArray(R"({"snrDb": [], "detectors": [{"name": "a"}]})") << QByteArray("snrDb");
        QTest::newRow("longer than its block")
            << QByteArray(R"({"durationWindows": 151, "detectors": [{"name": "a"}]})") << QByteArray("durationWindows");
        QTest::newRow("wanders too far") << QByteArray(R"({"wanderCells": 30, "detectors": [{"name": "a"}]})")
                                         << QByteArray("wanderCells");
        QTest::newRow("bad setting") << QByteArray(R"({"detectors": [{"name": "a", "settings": {"smd.k": 1}}]})")
                                     << QByteArray("smd.k");
        QTest::newRow("no recording") << QByteArray(R"({"kind": "injection", "detectors": [{"name": "a"}]})")
                                      << QByteArray("recording");
    }

    void refusals()
    {
        QFETCH(QByteArray, json);
        QFETCH(QByteArray, names);
        const std::string said =
            test::errorOf([&] { experimentFromJson(parseJson(json.toStdString(), "e.json"), "e.json"); });
        QVERIFY2(test::contains(said, names.toStdString()), said.c_str());
    }

private:
    QTemporaryDir m_folder;
    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }

    /// Lines far below and far above the noise.
    Experiment injectionIntoNoise() const
    {
        LineScene scene{.sampleRateHz = 500.0, .durationSeconds = 240.0};
        Experiment injection = Experiment::of(Experiment::Kind::Injection);
        injection.recording = path("noise.wav");
        writeRecording(SimulatedRecording(scene), injection.recording, WrittenType::Float32);
        injection.snrDb = {-30.0, 12.0};
        injection.durationSeconds = 20.0;
        return injection;
    }
};

FAINTLINE_TEST(tst_Campaign)
#include "tst_Campaign.moc"
