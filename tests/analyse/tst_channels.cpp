#include "analyse/analyse.h"
#include "base/Error.h"
#include "base/Random.h"
#include "inspect/advice.h"
#include "inspect/familyTeeth.h"
#include "signal/ArrayRecording.h"
#include "support/errors.h"
#include "support/frames.h"
#include "support/test.h"

#include <boost/math/special_functions/gamma.hpp>

#include <cmath>
#include <numbers>

using namespace faintline;

namespace {

constexpr double soundRate = 500.0;

struct Sound {
    double seconds = 60.0;
    int channels = 2;
    double common = 0.0;          ///< part of the noise's power that all channels have together
    std::vector<double> snrDb{};  ///< of the line in each channel, in a second
    std::vector<double> starts{}; ///< of a line of 40 s, s
    bool inSecondOnly = false;    ///< channel 0 hears no line
};

/// Noise of variance 1, and lines at 100 Hz and 20 Hz more for each.
RecordingPointer stereo(const Sound &sound)
{
    const auto count = Index(sound.seconds * soundRate);
    const auto channels = std::size_t(sound.channels);
    std::vector<float> shared(static_cast<std::size_t>(count)), own(shared.size());
    const auto samples = std::make_shared<std::vector<float>>(shared.size() * channels);
    Random(41, 0).normals(shared, 1.0f);
    for (std::size_t c = 0; c < channels; ++c) {
        Random(41, c + 1).normals(own, 1.0f);
        for (std::size_t n = 0; n < own.size(); ++n)
            (*samples)[n * channels + c] =
                float(std::sqrt(1.0 - sound.common)) * own[n] + float(std::sqrt(sound.common)) * shared[n];
        for (std::size_t line = 0; line < sound.starts.size(); ++line)
            for (auto n = std::size_t(sound.starts[line] * soundRate);
                 n < std::size_t((sound.starts[line] + 40.0) * soundRate); ++n) {
                const double amplitude = std::sqrt(4.0 * std::pow(10.0, 0.1 * sound.snrDb[line]) / soundRate);
                const double cycles = (100.0 + 20.0 * double(line)) * double(n) / soundRate + 0.3 * double(c);
                if (!(sound.inSecondOnly && c == 0))
                    (*samples)[n * channels + c] += float(amplitude * std::sin(2.0 * std::numbers::pi * cycles));
            }
    }
    return std::make_shared<ArrayRecording>("stereo", std::shared_ptr<const float>(samples, samples->data()),
                                            ArrayLayout{soundRate, count, sound.channels, false, 0.0});
}

AnalysisSettings channels(std::vector<double> added)
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 1.0;
    settings.selection.channels = std::move(added);
    return settings;
}

std::vector<float> frameOf(const Analysis &analysis, Index frame)
{
    std::vector<float> y(std::size_t(analysis.grid().size()));
    analysis.frames->read(frame, 1, y);
    return y;
}

std::shared_ptr<const Analysis> quick(const RecordingPointer &recording, const AnalysisSettings &settings)
{
    return analyse(recording, settings,
                   {.calibration = CalibrationDepth::FirstEstimate, .depth = AnalysisDepth::Tracks});
}

} // namespace

/// Channels of one recording, whose evidence is added.
class tst_channels : public QObject
{
    Q_OBJECT

private slots:
    void addTheirPower();
    void addThoseOfAFamily();
    void orderFewFalseAlarms();
    void gainOverOne();
    void areExplainedOneByOne();
    void warnOfCommonNoise_data();
    void warnOfCommonNoise();
    void areChosenTogetherOrAlone();
    void areRefused_data();
    void areRefused();
};

/// -ln Q(2, y0 + y1), each channel over its own noise.
void tst_channels::addTheirPower()
{
    const RecordingPointer recording = stereo({});
    const auto both = quick(recording, channels({-1.0}));
    AnalysisSettings second = channels({});
    second.selection.channel = 1;
    const auto y0 = frameOf(*quick(recording, channels({})), 30);
    const auto y1 = frameOf(*quick(recording, second), 30);
    const auto y = frameOf(*both, 30);
    QCOMPARE(y.size(), y0.size());
    for (std::size_t cell = 0; cell < y.size(); ++cell) {
        const double expected = -std::log(boost::math::gamma_q(2.0, double(y0[cell]) + double(y1[cell])));
        QVERIFY2(std::abs(double(y[cell]) - expected) < 2e-3 * std::max(1.0, expected),
                 qPrintable(QStringLiteral("%1: %2 %3").arg(cell).arg(double(y[cell])).arg(expected)));
    }
    QCOMPARE(both->lines.size(), std::size_t(2));
}

/// A member is a place and a channel: four of them here, or the larger of two pairs.
void tst_channels::addThoseOfAFamily()
{
    const RecordingPointer recording = stereo({});
    for (const auto present : {FamilySettings::Present::Together, FamilySettings::Present::InTurn}) {
        AnalysisSettings settings = channels({0.0, 1.0});
        settings.family = {FamilySettings::Relation::Offsets, {0.0, 20.0}, present};
        const auto analysis = quick(recording, settings);
        settings.family = {};
        settings.selection.channels.clear();
        const auto y0 = frameOf(*quick(recording, settings), 30);
        settings.selection.channel = 1;
        const auto y1 = frameOf(*quick(recording, settings), 30);
        const auto y = frameOf(*analysis, 30);
        const auto apart = std::size_t(std::lround(20.0 / analysis->grid().axes.back().step));
        for (std::size_t cell = 100; cell < 200; ++cell) {
            const double low = double(y0[cell]) + double(y1[cell]);
            const double high = double(y0[cell + apart]) + double(y1[cell + apart]);
            const double largest = -std::log(boost::math::gamma_q(2.0, std::max(low, high)));
            const double expected = present == FamilySettings::Present::Together
                                        ? -std::log(boost::math::gamma_q(4.0, low + high))
                                        : -std::log(1.0 - std::pow(1.0 - std::exp(-largest), 2.0));
            QVERIFY2(std::abs(double(y[cell]) - expected) < 3e-3 * std::max(1.0, expected),
                     qPrintable(QStringLiteral("%1: %2 %3").arg(cell).arg(double(y[cell])).arg(expected)));
        }
    }
}

/// Half an hour of noise at 40 false alarms an hour: 20 of them.
void tst_channels::orderFewFalseAlarms()
{
    AnalysisSettings settings = channels({0.0, 1.0});
    settings.decide.falseAlarmsPerHour = 40.0;
    const auto count = analyse(stereo({.seconds = 1800.0}), settings)->tracks.size();
    QVERIFY2(count >= 8 && count <= 34, qPrintable(QString::number(count))); // Poisson, 99.8 %
}

/// Lines that one channel hardly ever finds are found in two.
void tst_channels::gainOverOne()
{
    Sound sound{.seconds = 780.0};
    for (int line = 0; line < 7; ++line) {
        sound.snrDb.push_back(-0.5);
        sound.starts.push_back(30.0 + 105.0 * line);
    }
    const RecordingPointer recording = stereo(sound);
    const auto found = [&](const Analysis &analysis) {
        int count = 0;
        for (std::size_t line = 0; line < sound.starts.size(); ++line) {
            const auto all = events(analysis);
            count += std::any_of(all.begin(), all.end(), [&](const Event &event) {
                return std::abs(event.position[0] - (100.0 + 20.0 * double(line))) < 2.0
                       && event.onsetSeconds < sound.starts[line] + 40.0 && event.endSeconds > sound.starts[line];
            });
        }
        return count;
    };
    const int alone = found(*analyse(recording, channels({})));
    const int together = found(*analyse(recording, channels({0.0, 1.0})));
    QVERIFY2(together >= 5 && together >= alone + 3,
             qPrintable(QStringLiteral("%1 alone, %2 together").arg(alone).arg(together)));
}

/// The one without a line takes evidence away.
void tst_channels::areExplainedOneByOne()
{
    const auto analysis = quick(stereo({.snrDb = {9.0}, .starts = {10.0}, .inSecondOnly = true}), channels({0.0, 1.0}));
    const Index cell = analysis->grid().axes.back().nearest(100.0);
    std::vector<PathCell> path;
    for (Index frame = 30; frame < 90; ++frame)
        path.push_back({frame, cell});
    const std::vector<FamilyTooth> teeth = familyTeeth(*analysis, path);
    QCOMPARE(teeth.size(), std::size_t(2));
    for (const int channel : {0, 1}) {
        const FamilyTooth &tooth = teeth[std::size_t(channel)];
        QCOMPARE(tooth.channel, channel);
        QCOMPARE(tooth.isSeen(), channel == 1);
        QVERIFY(std::abs(tooth.hz - 100.0) < 0.5);
    }
}

void tst_channels::warnOfCommonNoise_data()
{
    QTest::addColumn<double>("common");
    QTest::addColumn<bool>("isWarned");
    QTest::newRow("none") << 0.0 << false;
    QTest::newRow("a third of its power") << 0.35 << true; // |γ|² = 0.12
    QTest::newRow("most of it") << 0.8 << true;
}

void tst_channels::warnOfCommonNoise()
{
    QFETCH(double, common);
    QFETCH(bool, isWarned);
    const RecordingPointer recording = stereo({.seconds = 200.0, .common = common, .snrDb = {20.0}, .starts = {20.0}});
    const auto advice = adviceOnChannels(*quick(recording, channels({0.0, 1.0})));
    QCOMPARE(advice.has_value(), isWarned);
    if (!advice)
        return;
    char coherence[32];
    std::snprintf(coherence, sizeof coherence, "coherence %.2f", common * common);
    const double told = std::stod(advice->sentence.substr(advice->sentence.find("coherence ") + 10));
    QVERIFY2(std::abs(told - common * common) < 0.02, advice->sentence.c_str());
    QVERIFY(advice->settings.selection.channels.empty());
    QVERIFY(!adviceOnChannels(*quick(recording, channels({}))));
}

void tst_channels::areChosenTogetherOrAlone()
{
    AnalysisSettings settings;
    setSetting(settings, "selection.channels", "2, 0");
    QCOMPARE(settings.selection.channel, 2);
    QVERIFY(settingsFromJson(settingsToJson(settings), "test") == settings);
    setSetting(settings, "selection.channel", "1");
    QVERIFY(settings.selection.channels.empty());
    setSetting(settings, "selection.channels", "all");
    QCOMPARE(settings.selection.channels, std::vector{-1.0});
    QCOMPARE(settings.selection.channel, 0);
    QVERIFY(settingsFromJson(settingsToJson(settings), "test") == settings);
    QVERIFY(settingsFromJson(R"({"selection.channels": "all"})", "test") == settings);
    RecordingInfo info;
    info.channelCount = 3;
    QCOMPARE(channelsOf(settings.selection, info), (std::vector{0, 1, 2}));
}

void tst_channels::areRefused_data()
{
    QTest::addColumn<std::vector<double>>("added");
    QTest::addColumn<QString>("why");
    QTest::newRow("not there") << std::vector{0.0, 2.0} << "the recording has 2 channel(s), counted from 0";
    QTest::newRow("one, not there") << std::vector{5.0} << "selection.channels = 5: the recording has 2 channel(s)";
    QTest::newRow("twice") << std::vector{1.0, 1.0} << "must not name a channel twice";
    QTest::newRow("a fraction") << std::vector{0.5} << "must be whole numbers";
    QTest::newRow("below 0") << std::vector{0.0, -1.0} << "or \"all\"";
}

void tst_channels::areRefused()
{
    QFETCH(std::vector<double>, added);
    QFETCH(QString, why);
    const std::string said = test::errorOf([&] { analyse(stereo({}), channels(added)); });
    QVERIFY2(test::contains(said, why.toStdString()), said.c_str());
    QVERIFY(test::contains(said, "selection.channels = "));
    QVERIFY_EXCEPTION_THROWN(analyse(test::framesOf(30, std::vector<float>(600, 1.0f)), channels({0.0, 1.0})), Error);
    AnalysisSettings subtracting = channels({0.0, 1.0});
    subtracting.subtract.lines = true;
    QVERIFY_EXCEPTION_THROWN(checkSettings(subtracting), Error);
}

FAINTLINE_TEST(tst_channels)
#include "tst_channels.moc"
