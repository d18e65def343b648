#include "analyse/analyse.h"
#include "base/Error.h"
#include "inspect/learnMotion.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

std::shared_ptr<const Analysis> analysisOf(double wanderHz, double wanderSeconds, double drift,
                                           const ModelSettings &law = {})
{
    LineScene scene{.sampleRateHz = 400.0, .durationSeconds = 300.0, .seed = 11};
    for (int i = 0; i < 3; ++i) {
        LineSettings line{.snrDb = 10.0,
                          .referenceSeconds = 0.25,
                          .frequencyHz = 50.0 + 50.0 * i,
                          .driftHzPerSecond = drift,
                          .wanderHz = wanderHz,
                          .wanderSeconds = wanderSeconds};
        scene.lines.push_back(line);
    }
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.25;
    settings.model = law;
    return analyse(std::make_shared<SimulatedRecording>(scene), settings);
}

bool isALaw(const std::vector<double> &law)
{
    double sum = law.front();
    for (std::size_t i = 1; i < law.size(); ++i)
        sum += 2.0 * law[i];
    return std::abs(sum - 1.0) < 1e-12;
}

} // namespace

/// The law of motion learned from tracks, on lines that keep their slope and lines that wander.
class tst_learnMotion : public QObject
{
    Q_OBJECT

private slots:
    void linesThatKeepTheirSlope()
    {
        const auto analysis = analysisOf(0.0, 1.0, 0.05);
        QVERIFY(canLearnMotion(*analysis));
        const LearnedMotion motion = learnMotion(*analysis);
        QVERIFY(isALaw(motion.learned));
        QVERIFY2(motion.learned.front() > 0.93, qPrintable(QString::number(motion.learned.front())));
        QCOMPARE(motion.tracks, std::size_t(3));
        QVERIFY(motion.frames > 0.9 * 3.0 * 2395.0);
    }

    /// Lines that keep their slope pay ln 3 a frame under a law without inertia, of which K gives back a part.
    void inertiaGainsWhereItLacked()
    {
        const LearnedMotion motion = learnMotion(*analysisOf(0.0, 1.0, 0.05, laws::billon()));
        QVERIFY2(motion.learned.front() > 0.9, qPrintable(QString::number(motion.learned.front())));
        QVERIFY2(motion.gainPerFrame > 0.05, qPrintable(QString::number(motion.gainPerFrame)));
        QVERIFY(std::abs(motion.gainOver(100.0) - 100.0 * motion.gainPerFrame - motion.presentThreshold
                         + motion.learnedThreshold)
                < 1e-9);
        const LearnedMotion usual = learnMotion(*analysisOf(0.0, 1.0, 0.05));
        QVERIFY(usual.gainPerFrame < 0.2 * motion.gainPerFrame); // the default has enough of it
    }

    void linesThatWanderChangeMoreOften()
    {
        const LearnedMotion steady = learnMotion(*analysisOf(0.0, 1.0, 0.05));
        const LearnedMotion wandering = learnMotion(*analysisOf(4.0, 2.0, 0.0));
        QVERIFY(isALaw(wandering.learned));
        QVERIFY2(wandering.learned.front() < steady.learned.front() - 0.03,
                 qPrintable(QString("%1 %2").arg(wandering.learned.front()).arg(steady.learned.front())));
    }

    void appliedItIsUsed()
    {
        const auto analysis = analysisOf(0.0, 1.0, 0.05);
        const LearnedMotion motion = learnMotion(*analysis);
        const AnalysisSettings settings = withLearnedMotion(*analysis, motion);
        QVERIFY(settings.model.slopeChange == motion.learned);
        QCOMPARE(settings.spectrogram.windowSeconds, 0.25);
        checkSettings(settings);
        QCOMPARE(analyse(analysis->recording, settings)->calibration->lnK, motion.learnedLnK);
    }

    void nothingToLearnFrom()
    {
        LineScene noise{.sampleRateHz = 400.0, .durationSeconds = 60.0};
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.25;
        const auto analysis = analyse(std::make_shared<SimulatedRecording>(noise), settings);
        QVERIFY(!canLearnMotion(*analysis));
        QVERIFY_EXCEPTION_THROWN(learnMotion(*analysis), Error);
    }
};

FAINTLINE_TEST(tst_learnMotion)
#include "tst_learnMotion.moc"
