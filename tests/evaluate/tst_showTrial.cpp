#include "evaluate/experiments/showTrial.h"
#include "support/test.h"

#include "evaluate/experiments/campaignCurve.h"
#include "evaluate/experiments/peers.h"
#include "plan/chain.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

/// The trial behind a point, made again: its truth lies in its frames, and it answers as it did in the campaign.
class tst_showTrial : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        Experiment lines{.trials = 1,
                         .frames = 300,
                         .snrDb = {6.0},
                         .durationSeconds = 40.0,
                         .detectors = {peer("SMD stable", 40.0), peer("integrator", 40.0), peer("3 of 4", 40.0)}};
        m_campaign.experiment = lines;
        carryOut(m_campaign, {0});
    }

    void everySignalIsATrial()
    {
        const auto trials = trialsOf(m_campaign, {1, 0});
        QCOMPARE(trials.size(), std::size_t(5)); // one block in time, five in frequency
        for (std::size_t i = 0; i < trials.size(); ++i) {
            QCOMPARE(trials[i].place, (TrialPlace{0, int(i)}));
            QCOMPARE(trials[i].isDetected, trials[i].statistic > shownThreshold(m_campaign, 1));
        }
        // 6 dB for forty windows: every detector finds that.
        QVERIFY(std::all_of(trials.begin(), trials.end(), [](const TrialOutcome &trial) { return trial.isDetected; }));
    }

    void theTrialAnswersAsInTheCampaign_data()
    {
        QTest::addColumn<int>("index");
        QTest::newRow("SMD stable") << 0;
        QTest::newRow("3 of 4") << 2;
    }

    void theTrialAnswersAsInTheCampaign()
    {
        QFETCH(int, index);
        const auto d = std::size_t(index);
        const TrialOutcome outcome = trialsOf(m_campaign, {d, 0})[2];
        const ShownTrial shown = showTrial(m_campaign, nullptr, {d, 0}, outcome.place);
        const Analysis &analysis = *shown.analysis;
        QCOMPARE(analysis.time().count, Index(300));
        QCOMPARE(analysis.grid().size(), Index(200));
        QVERIFY(std::abs(analysis.threshold - shownThreshold(m_campaign, d)) < 1e-12);

        // In the block alone paths from the neighbouring blocks are missing, which a line of 6 dB does not need.
        const TruthLine &truth = shown.truth.lines.front();
        const Axis &time = analysis.time();
        const Axis &frequency = analysis.grid().axes.front();
        double largest = -1e9;
        const auto detector = makeDetector(analysis); // without the tracks' own scores that a chain paints over it
        std::vector<float> y(std::size_t(frequency.count));
        std::vector<float> statistic(y.size());
        for (Index frame = 0; frame < time.count; ++frame) {
            analysis.frames->read(frame, 1, y);
            detector->update(y, statistic);
            const double seconds = time.value(double(frame));
            if (seconds < truth.startSeconds - 1e-9 || seconds > truth.endSeconds + 1e-9)
                continue;
            largest = std::max(largest, double(statistic[std::size_t(frequency.nearest(truth.frequencyAt(seconds)))]));
        }
        QVERIFY2(std::abs(largest - outcome.statistic) < 1e-3 * (1.0 + std::abs(outcome.statistic)),
                 qPrintable(QString("%1 in the trial, %2 in the campaign").arg(largest).arg(outcome.statistic)));
    }

    void anInjectionNeedsItsRecording()
    {
        Experiment injection = Experiment::of(Experiment::Kind::Injection);
        injection.detectors = {peer("3 of 4", 40.0)};
        const Campaign elsewhere{injection, {3.0}, {}};
        QVERIFY(trialsOf(elsewhere, {0, 0}).empty());
        QVERIFY_EXCEPTION_THROWN(showTrial(elsewhere, nullptr, {0, 0}, {}), Error);
    }

private:
    Campaign m_campaign;
};

FAINTLINE_TEST(tst_showTrial)
#include "tst_showTrial.moc"
