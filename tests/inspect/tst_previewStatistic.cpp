#include "analyse/analyse.h"
#include "calibrate/fitReset.h"
#include "detect/ModelBank.h"
#include "inspect/previewStatistic.h"
#include "noise/NoiseNormaliser.h"
#include "scene/SimulatedPings.h"
#include "scene/SimulatedRecording.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

/// Four minutes of noise at 400 Hz in a band of its own, which has no blind edges.
NormalisedFramesPointer noise(int seed)
{
    LineScene scene{.sampleRateHz = 400.0, .durationSeconds = 240.0, .seed = seed};
    SpectrogramSettings cut;
    cut.windowSeconds = 0.5;
    const SelectionSettings band{0, {}, 0.0, 0.0, 20.0, 180.0};
    const auto spectrogram = std::make_shared<Spectrogram>(std::make_shared<SimulatedRecording>(scene), cut, band);
    const NormaliserSettings settings;
    return std::make_shared<NormalisedSpectrogram>(spectrogram, estimateBackground(*spectrogram, settings), settings);
}

std::shared_ptr<const Analysis> analysed()
{
    LineScene scene{.sampleRateHz = 400.0, .durationSeconds = 120.0};
    const auto recording = std::make_shared<SimulatedRecording>(scene);
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.5;
    settings.selection.lowHz = 20.0; // a band of one's own has no blind edges
    settings.selection.highHz = 180.0;
    settings.decide.by = DecideSettings::By::Nats;
    settings.decide.thresholdNats = 500.0; // nothing is detected, so no feedback
    return analyse(recording, settings);
}

std::vector<float> valuesOf(const PeakPyramid &picture)
{
    std::vector<float> values;
    for (Index row = 0; row < picture.rowCount(0); ++row)
        for (const std::uint8_t byte : picture.row(0, row))
            values.push_back(float(picture.scale().value(byte)));
    return values;
}

StatisticPreview previewed(const Analysis &before, const AnalysisSettings &settings, Index first, Index last,
                           int threads = 1)
{
    const FrameRange range = previewRange(*before.frames, first, last);
    const KeptFrames kept(before.frames, range.readFirst, range.end - range.readFirst);
    RunContext context;
    context.threads = threads;
    return previewStatistic(before, settings, range, kept, context);
}

} // namespace

/// A changed detector's statistic of a few frames, before anything is calibrated for it.
class tst_previewStatistic : public QObject
{
    Q_OBJECT

private slots:
    void rangesByHand()
    {
        const auto before = analysed();
        const FrameRange middle = previewRange(*before->frames, 200, 300);
        QCOMPARE(middle.readFirst, Index(72)); // 128 before
        QCOMPARE(middle.first, Index(200));
        QCOMPARE(middle.end, Index(301));
        const FrameRange all = previewRange(*before->frames, -5, 100000);
        QCOMPARE(all.readFirst, Index(0));
        QCOMPARE(all.first, Index(0));
        QCOMPARE(all.end, before->time().count);
        const Axis hertz{"frequency", "Hz", 0.0, 1.0, 1000, false};
        const auto large = std::make_shared<FrameArray>(Axis{"time", "s", 0.0, 1.0, 100000, false}, Grid{{hertz}},
                                                        std::vector<float>());
        QVERIFY(previewRange(*large, 0, 99999).isEmpty());
        QVERIFY(previewRange(*large, 5000, 6000).isKeepable);
        QVERIFY(!previewRange(*large, 5000, 55000).isEmpty() && !previewRange(*large, 5000, 55000).isKeepable);
        const Grid plane{{{"range", "m", 0.0, 1.0, 10, false}, {"bearing", "°", 0.0, 1.0, 10, true}}};
        const FrameArray pings(Axis{"time", "s", 0.0, 1.0, 30, false}, plane, {});
        QCOMPARE(previewRange(pings, 29, 29).readFirst, Index(13)); // 16 before
        QCOMPARE(previewRange(pings, 4, 4).readFirst, Index(0));
        QCOMPARE(previewRange(pings, 4, 4).end, Index(5));
    }

    void whatIsWorthIt()
    {
        const auto before = analysed();
        AnalysisSettings settings = before->settings;
        QVERIFY(!isWorthAPreview(*before, settings));
        settings.decide.thresholdNats = 20.0;
        QVERIFY(!isWorthAPreview(*before, settings)); // its statistic changes where tracks start only
        settings.model.snr = 0.25;
        QVERIFY(isWorthAPreview(*before, settings));
        settings.spectrogram.windowSeconds = 0.25;
        QVERIFY(!isWorthAPreview(*before, settings)); // other frames
    }

    void isTheRecursion()
    {
        // With a given ln K from frame 0 on it is what the detector says of these frames, one by one.
        const auto before = analysed();
        AnalysisSettings settings = before->settings;
        settings.model.snr = 0.3;
        settings.detector = SmdSettings{SmdSettings::Reset::Fixed, -0.7};
        const StatisticPreview preview = previewed(*before, settings, 0, before->time().count - 1);
        QCOMPARE(preview.lnK, -0.7);
        Smd smd(makeModel(settings.model, before->grid()), {ResetLaw::Fixed, -0.7});
        PeakPyramid expected(before->time(), before->grid().size(), ByteScale(ByteScale::Kind::ScoreNats));
        std::vector<float> y(std::size_t(before->grid().size())), statistic(y.size());
        for (Index frame = 0; frame < before->time().count; ++frame) {
            before->frames->read(frame, 1, y);
            smd.update(y, statistic);
            expected.append(statistic);
        }
        expected.finish();
        QVERIFY(valuesOf(*preview.statistic) == valuesOf(expected));
        const StatisticPreview streamed =
            previewStatistic(*before, settings, previewRange(*before->frames, 0, 10000), *before->frames);
        QVERIFY(valuesOf(*streamed.statistic) == valuesOf(expected));
        QCOMPARE(preview.statistic->time().first, before->time().first);
    }

    void pingsAreTheRecursionFromSixteenBefore()
    {
        PingScene scene{.pings = 24, .rangeCells = 40, .beams = 6};
        Analysis before;
        before.settings = preset("sonar").settings;
        before.settings.model.motion = Motion::Bank;
        before.settings.model.lowestSlope = -1;
        before.settings.model.highestSlope = 1;
        before.frames = std::make_shared<SimulatedPings>(scene);
        before.calibration = std::make_shared<Calibration>();
        const std::vector<MarkovModel> models = makeModels(before.settings.model, before.grid());
        before.model = models.front();
        std::vector<ModelBank::Member> members;
        const auto &smd = std::get<SmdSettings>(before.settings.detector);
        for (const MarkovModel &model : models) {
            before.bank.push_back({model, before.calibration, before.bank.empty() ? 0.0 : 1.5});
            members.push_back({model, resetRule(smd, 0.0), before.bank.back().offset});
        }
        QVERIFY(!isWorthAPreview(before, before.settings));
        AnalysisSettings changed = before.settings;
        changed.model.snr *= 1.5;
        QVERIFY(isWorthAPreview(before, changed));
        for (const bool isBank : {true, false}) {
            changed.model.motion = isBank ? Motion::Bank : Motion::Slopes;
            const StatisticPreview preview = previewed(before, changed, 20, 20, 2);
            QCOMPARE(preview.statistic->rowCount(0), Index(1));
            QCOMPARE(preview.statistic->time().first, before.time().value(20.0));
            const std::vector<MarkovModel> now = makeModels(changed.model, before.grid());
            std::vector<ModelBank::Member> parts = members;
            parts.resize(now.size());
            for (std::size_t i = 0; i < now.size(); ++i)
                parts[i].model = now[i];
            ModelBank bank(parts);
            std::vector<float> y(std::size_t(before.grid().size())), statistic(y.size());
            for (Index ping = 4; ping <= 20; ++ping) {
                before.frames->read(ping, 1, y);
                bank.update(y, statistic);
            }
            PeakPyramid expected(before.time(), before.grid().size(), ByteScale(ByteScale::Kind::ScoreNats));
            expected.append(statistic);
            expected.finish();
            QVERIFY(valuesOf(*preview.statistic) == valuesOf(expected));
        }
    }

    void findsNearlyTheCalibratedK()
    {
        const auto before = analysed();
        for (const double snr : {0.2, 1.0, 2.0}) {
            AnalysisSettings settings = before->settings;
            settings.model.snr = snr;
            const StatisticPreview preview = previewed(*before, settings, 200, 300);
            // As the calibration finds it, on other noise of the same kind.
            const double lnK =
                fitReset({noise(7), noise(8)}, makeModel(settings.model, before->grid()), SmdSettings()).lnK;
            QVERIFY2(std::abs(preview.lnK - lnK) < 0.1, qPrintable(QStringLiteral("%1 %2").arg(preview.lnK).arg(lnK)));
        }
    }

    void showsTheRightFrames()
    {
        // The middle of a longer one: the same values, once the detector has settled, at the same times.
        const auto before = analysed();
        AnalysisSettings settings = before->settings;
        settings.detector = SmdSettings{SmdSettings::Reset::Fixed, before->calibration->lnK};
        const StatisticPreview part = previewed(*before, settings, 200, 299);
        const StatisticPreview whole = previewed(*before, settings, 0, 400);
        QCOMPARE(part.statistic->frameCount(), Index(100));
        QCOMPARE(part.statistic->time().first, before->time().value(200.0));
        const std::vector<float> there = valuesOf(*whole.statistic);
        const std::vector<float> here = valuesOf(*part.statistic);
        const Index cells = before->grid().size();
        Index different = 0;
        for (std::size_t i = 0; i < here.size(); ++i)
            different += here[i] != there[i + std::size_t(200 * cells)] ? 1 : 0;
        QVERIFY2(different < std::ssize(here) / 1000, qPrintable(QString::number(different)));
    }

    void otherDetectorsAndThreads()
    {
        const auto before = analysed();
        AnalysisSettings settings = before->settings;
        settings.detector = EnergySettings{};
        const StatisticPreview energy = previewed(*before, settings, 10, 20);
        std::vector<float> y(std::size_t(before->grid().size()));
        before->frames->read(10, 1, y);
        QVERIFY(std::abs(valuesOf(*energy.statistic)[7] - std::max(y[7], -4.0f)) <= 0.126f);
        settings = before->settings;
        settings.model.snr = 1.5;
        const StatisticPreview one = previewed(*before, settings, 100, 400, 1),
                               four = previewed(*before, settings, 100, 400, 4);
        QVERIFY(valuesOf(*one.statistic) == valuesOf(*four.statistic));
        QCOMPARE(one.lnK, four.lnK);
    }

    void keptFramesKnowWhatTheyAre()
    {
        const auto before = analysed();
        const KeptFrames kept(before->frames, 50, 100);
        QVERIFY(kept.holds(before->frames, 50, 150));
        QVERIFY(!kept.holds(before->frames, 49, 150));
        QVERIFY(!kept.holds(before->frames, 60, 151));
        QVERIFY(!kept.holds(analysed()->frames, 60, 100));
        std::vector<float> y(std::size_t(before->grid().size())), same(y.size());
        before->frames->read(149, 1, y);
        kept.read(149, 1, same);
        QVERIFY(same == y);
    }
};

FAINTLINE_TEST(tst_previewStatistic)
#include "tst_previewStatistic.moc"
