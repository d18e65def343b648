#include "analyse/analyse.h"
#include "inspect/closeup.h"
#include "support/test.h"

#include "scene/SimulatedRecording.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

constexpr std::size_t plenty = std::size_t(64) << 20;

/// Half a minute with a line that is found and followed.
std::shared_ptr<const Analysis> analysed(const DetectorSettings &detector = SmdSettings{})
{
    LineScene scene{.sampleRateHz = 400.0, .durationSeconds = 120.0, .seed = 3};
    LineSettings line{
        .snrDb = 8.0, .startSeconds = 20.0, .durationSeconds = 70.0, .frequencyHz = 90.0, .driftHzPerSecond = 0.2};
    scene.lines = {line};
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.5;
    settings.detector = detector;
    settings.decide.by = DecideSettings::By::Nats;
    settings.decide.thresholdNats = 14.0;
    return analyse(std::make_shared<SimulatedRecording>(scene), settings);
}

/// The same pictures with the memory of a much longer recording.
std::shared_ptr<const PeakPyramid> merged(const PeakPyramid &picture, std::size_t bytes)
{
    auto result = std::make_shared<PeakPyramid>(picture.time(), picture.cells(), picture.scale(), bytes);
    for (Index frame = 0; frame < picture.frameCount(); ++frame)
        result->appendBytes(picture.row(0, frame));
    result->finish();
    return result;
}

const std::shared_ptr<const Analysis> &analysedOnce()
{
    static const auto result = analysed();
    return result;
}

} // namespace

class tst_closeup : public QObject
{
    Q_OBJECT

private:
    static void compareRows(const PeakPyramid &closeup, const PeakPyramid &whole, const FrameStretch &stretch)
    {
        QCOMPARE(closeup.framesPerRow(0), Index(1));
        QCOMPARE(closeup.frameCount(), stretch.end - stretch.begin);
        QCOMPARE(closeup.time().first, whole.time().value(double(stretch.begin)));
        for (Index frame = stretch.begin; frame < stretch.end; ++frame)
            QVERIFY2(std::ranges::equal(closeup.row(0, frame - stretch.begin), whole.row(0, frame)),
                     QByteArray::number(qlonglong(frame)));
    }

private slots:
    void plainPictureHasTheLevelsOfTheRecording()
    {
        const Analysis &analysis = *analysedOnce();
        // The noise has a deviation of 0.1.
        const double density = 10.0 * std::log10(0.1 * 0.1 * 2.0 / 400.0);
        const auto [plain, reference] = plainPicture(analysis, plenty).value();
        QVERIFY2(std::abs(reference - density) < 1.0, QByteArray::number(reference));
        QCOMPARE(plain->frameCount(), analysis.time().count);
        const Index beside = plain->cells() / 4; // of the line
        double power = 0.0;
        for (Index frame = 0; frame < plain->frameCount(); ++frame)
            for (const std::uint8_t byte : plain->row(0, frame).subspan(std::size_t(plain->cells() - beside)))
                power += std::pow(10.0, 0.1 * plain->scale().value(byte));
        const auto count = double(plain->frameCount() * beside);
        const double meanDb = 10.0 * std::log10(power / count) + reference;
        QVERIFY2(std::abs(meanDb - density) < 0.15, QByteArray::number(meanDb));
    }

    void holdsWhatTheWholeDoes_data()
    {
        QTest::addColumn<int>("kind");
        QTest::newRow("with checkpoints") << 0;
        QTest::newRow("of a detector that cannot tell its state") << 1;
    }

    void holdsWhatTheWholeDoes()
    {
        QFETCH(int, kind);
        const auto analysis = analysed(kind == 0 ? DetectorSettings(SmdSettings{}) : DetectorSettings(PofNSettings{}));
        QVERIFY(!analysis->tracks.empty()); // so trackers take part
        QCOMPARE(analysis->checkpoints.isEmpty(), kind == 1);
        QCOMPARE(analysis->statistic->framesPerRow(0), Index(1));
        const Index frames = analysis->time().count;
        for (const FrameStretch &stretch : {FrameStretch{0, 9}, {63, 66}, {130, 300}, {frames - 5, frames}}) {
            compareRows(*inputCloseup(*analysis, stretch, plenty), *analysis->input, stretch);
            compareRows(*statisticCloseup(*analysis, stretch, plenty), *analysis->statistic, stretch);
        }
    }

    void nothingWhereThePictureSaysAll()
    {
        const auto &analysis = analysedOnce();
        const PeakPyramid &single = *analysis->input;
        const auto fours = merged(single, std::size_t(single.frameCount() * single.cells() / 2));
        QCOMPARE(fours->framesPerRow(0), Index(4));
        const FrameStretch visible{101, 150};
        QVERIFY(closeupStretch(single, visible, 0.1, plenty).isEmpty());
        QVERIFY(closeupStretch(*fours, visible, 4.0, plenty).isEmpty()); // pixels as large as rows
        QVERIFY(closeupStretch(*fours, visible, 0.1, 1000).isEmpty());   // no room for finer ones
        QVERIFY(closeupStretch(*fours, {}, 0.1, plenty).isEmpty());

        const FrameStretch more = closeupStretch(*fours, visible, 0.1, plenty);
        QVERIFY(more.contains({77, 174}));
        QCOMPARE(more.begin % 4, Index(0));
        // Room for what is visible, not for as much again beside it.
        const FrameStretch least = closeupStretch(*fours, visible, 0.1, std::size_t(60 * single.cells() * 4 / 3));
        QVERIFY(least.contains(visible) && more.contains(least) && least.end - least.begin < 60);
        QCOMPARE(closeupStretch(*fours, {0, 5}, 0.1, plenty).begin, Index(0));
        QCOMPARE(closeupStretch(*fours, {single.frameCount() - 3, single.frameCount()}, 0.1, plenty).end,
                 single.frameCount());
    }

    void withLittleMemoryRowsAreMergedAlike()
    {
        const auto &analysis = analysedOnce();
        const FrameStretch stretch{64, 192};
        const auto closeup = inputCloseup(*analysis, stretch, std::size_t(100 * analysis->input->cells()));
        QCOMPARE(closeup->framesPerRow(0), Index(4));
        for (Index row = 0; row < closeup->rowCount(0); ++row)
            QVERIFY(std::ranges::equal(closeup->row(0, row), analysis->input->row(1, stretch.begin / 4 + row)));
    }

    void endsWhenAskedTo()
    {
        const auto &analysis = analysedOnce();
        std::stop_source stop;
        stop.request_stop();
        RunContext context;
        context.stop = stop.get_token();
        QVERIFY_THROWS_EXCEPTION(Cancelled, inputCloseup(*analysis, {0, 10}, plenty, context));
        QVERIFY_THROWS_EXCEPTION(Cancelled, statisticCloseup(*analysis, {0, 10}, plenty, context));
    }
};

FAINTLINE_TEST(tst_closeup)
#include "tst_closeup.moc"
