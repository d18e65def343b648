#include "inspect/closeup.h"
#include "support/test.h"

#include "analyse/analyse.h"
#include "signal/ArrayRecording.h"
#include "support/errors.h"
#include "support/recordings.h"

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double rate = 500.0;
constexpr Index sampleCount = 30'000;
constexpr std::size_t pictureBytes = std::size_t(8) << 20;

/// Three channels: noise, ten times louder noise with a line at 120 Hz, silence.
RecordingPointer threeChannels()
{
    const std::vector<float> quiet = someNoise(sampleCount, 1), loud = someNoise(sampleCount, 2);
    const auto samples = std::make_shared<std::vector<float>>(3 * quiet.size());
    for (std::size_t n = 0; n < quiet.size(); ++n) {
        (*samples)[3 * n] = quiet[n];
        (*samples)[3 * n + 1] =
            10.0f * loud[n] + 3.0f * float(std::sin(2.0 * std::numbers::pi * 120.0 * double(n) / rate));
    }
    return std::make_shared<ArrayRecording>("three", std::shared_ptr<const float>(samples, samples->data()),
                                            ArrayLayout{rate, sampleCount, 3, false, 0.0});
}

AnalysisSettings quickSettings()
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.5;
    setSetting(settings, "detector.kind", "energy");
    return settings;
}

bool areEqual(const PeakPyramid &a, const PeakPyramid &b)
{
    if (a.rowCount(0) != b.rowCount(0) || a.cells() != b.cells())
        return false;
    for (Index row = 0; row < a.rowCount(0); ++row)
        if (!std::ranges::equal(a.row(0, row), b.row(0, row)))
            return false;
    return true;
}

} // namespace

/// The picture of one channel.
class tst_channelPicture : public QObject
{
    Q_OBJECT

private slots:
    void isTheInputOfAnAnalysisOfThatChannel()
    {
        const RecordingPointer recording = threeChannels();
        std::vector<ChannelPicture> made;
        for (const int channel : {0, 1}) {
            AnalysisSettings settings = quickSettings();
            settings.selection.channel = channel;
            const auto analysis = analyse(recording, settings);
            settings.selection.channel = 1 - channel; // what is analysed does not matter
            settings.selection.channels = {0.0, 1.0};
            made.push_back(channelPicture(recording, settings, channel, pictureBytes));
            QVERIFY(made.back().frequency == analysis->grid().axes.back());
            QVERIFY(made.back().picture->time() == analysis->time());
            QVERIFY(areEqual(*made.back().picture, *analysis->input));
        }
        QVERIFY(!areEqual(*made[0].picture, *made[1].picture));
    }

    /// Levels are relative to the channel's own noise: a line at 120 Hz in the louder one, nothing in the other.
    void eachIsOverItsOwnNoise()
    {
        const RecordingPointer recording = threeChannels();
        const auto meanAt = [&](int channel, double hz) {
            const ChannelPicture made = channelPicture(recording, quickSettings(), channel, pictureBytes);
            const auto cell = std::size_t(made.frequency.nearest(hz));
            double sum = 0.0;
            for (Index row = 0; row < made.picture->rowCount(0); ++row)
                sum += std::pow(10.0, 0.1 * made.picture->scale().value(made.picture->row(0, row)[cell]));
            return sum / double(made.picture->rowCount(0));
        };
        QVERIFY(std::abs(meanAt(0, 120.0) - 1.0) < 0.4);
        QVERIFY(std::abs(meanAt(1, 180.0) - 1.0) < 0.4);
        // A²/4 · Σ²w over σ², plus 1: amplitude 3, deviation 2, and 2/3 of the window's 250 samples for a Hann window.
        const double expected = 1.0 + 9.0 / 4.0 * (250.0 * 2.0 / 3.0) / 4.0;
        QVERIFY2(std::abs(meanAt(1, 120.0) / expected - 1.0) < 0.25, qPrintable(QString::number(meanAt(1, 120.0))));
    }

    void rowsAreMergedWithinTheBudget()
    {
        const RecordingPointer recording = threeChannels();
        const ChannelPicture whole = channelPicture(recording, quickSettings(), 0, pictureBytes);
        const ChannelPicture small = channelPicture(recording, quickSettings(), 0, std::size_t(1) << 14);
        QCOMPARE(whole.picture->framesPerRow(0), Index(1));
        QVERIFY(small.picture->framesPerRow(0) > 1);
        QCOMPARE(small.picture->frameCount(), whole.picture->frameCount());
    }

    void silenceIsAnError()
    {
        const std::string said = errorOf([] { channelPicture(threeChannels(), quickSettings(), 2, pictureBytes); });
        QVERIFY(!said.empty() && !contains(said, "\n"));
    }

    void stopsWhenAsked()
    {
        std::stop_source source;
        source.request_stop();
        RunContext context;
        context.stop = source.get_token();
        QVERIFY_THROWS_EXCEPTION(Cancelled, channelPicture(threeChannels(), quickSettings(), 0, pictureBytes, context));
    }
};

FAINTLINE_TEST(tst_channelPicture)
#include "tst_channelPicture.moc"
