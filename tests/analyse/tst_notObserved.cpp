#include "analyse/analyse.h"
#include "base/Random.h"
#include "inspect/boxLevels.h"
#include "inspect/explain.h"
#include "inspect/pathEvidence.h"
#include "plan/makeDetector.h"
#include "support/frames.h"
#include "support/test.h"

#include <cmath>
#include <limits>
#include <numbers>

using namespace faintline;

namespace {

constexpr Index observedFrames = 240;
constexpr Index cells = 48;
constexpr float unobservedValue = std::numeric_limits<float>::quiet_NaN();

/// Noise with a line in cell 20 from frame 60 to 180; what was not observed, a third of the cells and some whole
/// frames, is `masked`.
std::vector<float> values(float masked)
{
    std::vector<float> y(std::size_t(observedFrames * cells));
    Random random(8, 1);
    random.exponentials(y);
    for (Index frame = 60; frame < 180; ++frame)
        y[std::size_t(frame * cells + 20)] += 9.0f;
    for (Index i = 0; i < std::ssize(y); ++i)
        if (random.uniform() < 0.33 || (i / cells) % 50 == 40)
            y[std::size_t(i)] = masked;
    return y;
}

NormalisedFramesPointer framesOf(std::vector<float> y)
{
    return test::framesOf(cells, std::move(y), 0.25, 0.5);
}

AnalysisSettings settings()
{
    AnalysisSettings chosen;
    chosen.model.likelihood = LikelihoodKind::Exponential;
    chosen.model.snr = 1.0;
    chosen.detector = SmdSettings{SmdSettings::Reset::Fixed, 0.6};
    chosen.decide.by = DecideSettings::By::Nats;
    chosen.decide.thresholdNats = 12.0;
    chosen.track.bothWays = false; // which cuts tracks at the signal's own level, for which other values are neutral
    return chosen;
}

} // namespace

/// NaN in ready-made frames: a cell that was not observed tells nothing, λ = 0.
class tst_notObserved : public QObject
{
    Q_OBJECT

private slots:
    void isTheSameAsNoEvidence()
    {
        const auto neutral = float(2.0 * std::numbers::ln2); // λ = y/2 - ln 2 = 0
        std::vector<float> shown;
        std::vector<float> expected;
        const auto sinkInto = [](std::vector<float> &all) {
            return StatisticSink(
                [&all](Index, std::span<const float> block) { all.insert(all.end(), block.begin(), block.end()); });
        };
        const auto masked = analyse(framesOf(values(unobservedValue)), settings(), {.statistic = sinkInto(shown)});
        const auto plain = analyse(framesOf(values(neutral)), settings(), {.statistic = sinkInto(expected)});
        QCOMPARE(shown.size(), expected.size());
        for (std::size_t i = 0; i < shown.size(); ++i)
            QVERIFY2(std::abs(shown[i] - expected[i]) < 1e-3f,
                     qPrintable(QStringLiteral("%1: %2, not %3").arg(i).arg(shown[i]).arg(expected[i])));
        QVERIFY(!plain->tracks.empty());
        QCOMPARE(masked->tracks.size(), plain->tracks.size());
        for (std::size_t i = 0; i < plain->tracks.size(); ++i) {
            QCOMPARE(masked->tracks[i].endFrame, plain->tracks[i].endFrame);
            QCOMPARE(masked->tracks[i].points.size(), plain->tracks[i].points.size());
        }
    }

    void isSaidSoOfAPath()
    {
        const auto analysis = analyse(framesOf(values(unobservedValue)), settings());
        const Track &track = analysis->tracks.front();
        double sum = 0.0;
        const Explanation why = explain(*analysis, analysis->time().value(double(track.detectFrame)),
                                        {analysis->grid().axes[0].value(double(track.points.back().cell))});
        int unobserved = 0;
        std::vector<float> y(cells);
        for (const PathStep &step : why.steps) {
            QVERIFY(std::isfinite(step.logLikelihoodRatio) && std::isfinite(step.score));
            analysis->frames->read(step.frame, 1, y);
            if (std::isnan(y[std::size_t(analysis->model.space.cellOf(step.state))])) {
                QCOMPARE(step.logLikelihoodRatio, 0.0);
                ++unobserved;
            }
            sum += step.logLikelihoodRatio;
        }
        QVERIFY(unobserved > 0 && std::isfinite(sum));
        std::vector<PathCell> path;
        for (Index frame = 60; frame < 180; ++frame)
            path.push_back({frame, 20});
        const PathEvidence evidence = evidenceAlong(*analysis, path);
        QVERIFY(std::isfinite(evidence.logLikelihoodRatio));
        QVERIFY2(std::abs(evidence.meanPower - 10.0) < 0.5, qPrintable(QString::number(evidence.meanPower)));
        const BoxLevels levels = boxLevels(*analysis, {60, 180, 20, 21});
        QVERIFY(levels.snrDb && std::abs(*levels.snrDb - 10.0 * std::log10(9.0)) < 0.7);
    }

    void noDetectorIsSpoilt()
    {
        const MarkovModel model = makeModel(settings().model, framesOf(values(1.0f))->grid());
        const std::vector<float> y = values(unobservedValue);
        for (std::size_t kind = 0; kind < std::variant_size_v<DetectorSettings>; ++kind) {
            const auto detector = makeDetector(detectorOfKind(kind), model, framesOf(values(1.0f))->grid(), {},
                                               ResetRule{ResetLaw::Fixed, 0.6});
            std::vector<float> statistic(cells);
            float largest = -std::numeric_limits<float>::infinity();
            for (Index frame = 0; frame < observedFrames; ++frame) {
                detector->update(std::span(y).subspan(std::size_t(frame * cells), cells), statistic);
                for (const float value : statistic) {
                    QVERIFY2(!std::isnan(value),
                             qPrintable(QStringLiteral("detector %1, frame %2").arg(kind).arg(frame)));
                    largest = std::max(largest, value);
                }
            }
            QVERIFY(std::isfinite(largest));
        }
    }
};

FAINTLINE_TEST(tst_notObserved)
#include "tst_notObserved.moc"
