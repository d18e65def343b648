#include "analyse/analyse.h"
#include "base/Random.h"
#include "refine/ownNoiseLaw.h"
#include "support/test.h"

#include "support/frames.h"
#include "support/recordings.h"

#include <cmath>
#include <numbers>

using namespace faintline;

namespace {

constexpr Index cells = 240; ///< six parts of 40
constexpr Index frameCount = 2000;
constexpr double degrees = 4.0; ///< of the Pareto law

/// Pareto's second law of mean 1, the mean of exponentials whose levels scatter:  P(Y > y) = (1 + y/(b - 1))^-b.
float pareto(Random &random)
{
    return float((degrees - 1.0) * std::expm1(random.exponential() / degrees));
}

double paretoWorth(double y)
{
    return std::min(y, degrees * std::log1p(y / (degrees - 1.0)));
}

/// Exponential below cell 120, Pareto's from there on.
std::vector<float> noise()
{
    Random random(5, 0);
    std::vector<float> y;
    for (Index i = 0; i < frameCount * cells; ++i)
        y.push_back(i % cells < cells / 2 ? float(random.exponential()) : pareto(random));
    return y;
}

FrameArray framesOf(std::vector<float> y)
{
    return *test::framesOf(cells, std::move(y));
}

/// Powers of a first-order autoregressive amplitude in the upper half of the band; independent ones below. Neighbouring
/// frames' powers correlate by ρ².
std::vector<float> runningNoise(double rho)
{
    Random random(6, 0);
    std::vector<float> y = noise();
    for (Index cell = 0; cell < cells; ++cell) {
        double re = random.normal();
        double im = random.normal();
        const double own = std::sqrt(1.0 - rho * rho);
        for (Index frame = 0; frame < frameCount; ++frame) {
            re = rho * re + own * random.normal();
            im = rho * im + own * random.normal();
            y[std::size_t(frame * cells + cell)] =
                cell < cells / 2 ? float(random.exponential()) : float((re * re + im * im) / 2.0);
        }
    }
    return y;
}

Track constantTrack(Index cell)
{
    Track track;
    for (Index frame = 0; frame < frameCount; ++frame)
        track.points.push_back({frame, cell, 0, 0.0});
    return track;
}

/// White noise with tones of one window at random places, one a second, and a line at 60 Hz from 100 to 200 s.
RecordingPointer burstsAndLine()
{
    constexpr double rate = 400.0;
    constexpr Index count = 400 * 600;
    constexpr Index length = 80;
    std::vector<float> samples(static_cast<std::size_t>(count));
    Random random(8, 0);
    random.normals(samples, 0.1f);
    for (Index second = 0; second < 600; ++second) {
        const double turns = random.uniform() * 0.5;
        const auto first = second * 400 + Index(random.uniform() * 300.0);
        for (Index i = 0; i < length; ++i)
            samples[std::size_t(first + i)] += float(0.1 * std::sin(2.0 * std::numbers::pi * turns * double(i)));
    }
    for (Index i = 400 * 100; i < 400 * 200; ++i)
        samples[std::size_t(i)] += float(0.03 * std::sin(2.0 * std::numbers::pi * 60.0 / rate * double(i)));
    return std::make_shared<test::MemoryRecording>(samples, rate);
}

/// Many narrow bands of noise, whose levels rise and fall by themselves within seconds, and a line at 60 Hz.
RecordingPointer swellsAndLine()
{
    constexpr double rate = 400.0;
    constexpr Index count = 400 * 300;
    std::vector<float> samples(static_cast<std::size_t>(count));
    Random random(9, 0);
    random.normals(samples, 0.1f);
    for (int band = 0; band < 40; ++band) { // one in 5 Hz, amplitudes that last for 1.2 s
        double re = 0.0;
        double im = 0.0;
        const double forgets = 1.0 / (1.2 * rate);
        const double turns = (double(band) + random.uniform()) / 80.0;
        for (Index i = 0; i < count; ++i) {
            re += -forgets * re + std::sqrt(2.0 * forgets) * random.normal();
            im += -forgets * im + std::sqrt(2.0 * forgets) * random.normal();
            const double phase = 2.0 * std::numbers::pi * std::fmod(turns * double(i), 1.0);
            samples[std::size_t(i)] += float(0.014 * (re * std::cos(phase) - im * std::sin(phase)));
        }
    }
    for (Index i = 400 * 100; i < 400 * 200; ++i)
        samples[std::size_t(i)] += float(0.06 * std::sin(2.0 * std::numbers::pi * 60.0 / rate * double(i)));
    return std::make_shared<test::MemoryRecording>(samples, rate);
}

} // namespace

/// What a recording's own noise is worth against laws in closed form, and which tracks it explains.
class tst_ownNoiseLaw : public QObject
{
    Q_OBJECT

private slots:
    void exponentialNoiseKeepsItsPower();
    void heavyTailsAreWorthTheirRarity();
    void tracksAreNoNoise();
    void aSteadyLineIsNoNoise();
    void aFewFramesTellNothing();
    void runsAreMeasured();
    void runsBetweenCrowdedTracksTellNothing();
    void burstsAreExplainedAndTheLineIsNot();
    void swellsAreExplainedAndTheLineIsNot();
};

void tst_ownNoiseLaw::exponentialNoiseKeepsItsPower()
{
    const OwnNoiseLaw law(framesOf(noise()), {}, 2.0, 1.0, {});
    for (const float y : {0.0f, 0.3f, 1.0f, 5.0f, 12.0f, 1e6f})
        for (const Index cell : {Index(0), Index(60), Index(119)})
            QCOMPARE(law(cell, y), y);
    QVERIFY(std::isnan(law(0, std::numeric_limits<float>::quiet_NaN())));
    QVERIFY(!law.isAsAssumed());
    std::vector<float> exponential = noise();
    for (std::size_t i = 0; i < exponential.size(); ++i)
        exponential[i] = exponential[i - i % cells + i % (cells / 2)];
    QVERIFY(OwnNoiseLaw(framesOf(exponential), {}, 2.0, 1.0, {}).isAsAssumed());
}

void tst_ownNoiseLaw::heavyTailsAreWorthTheirRarity()
{
    const OwnNoiseLaw law(framesOf(noise()), {}, 2.0, 1.0, {});
    // 80000 values a part: one in 1000 exceeds y = 14, known to a standard deviation of 0.11 nat.
    for (const float y : {1.0f, 2.0f, 4.0f, 8.0f, 14.0f})
        for (const Index cell : {Index(120), Index(180), Index(239)}) {
            const double error = double(law(cell, y)) - paretoWorth(double(y));
            QVERIFY2(std::abs(error) < 0.35, qPrintable(QStringLiteral("y %1: %2").arg(y).arg(error)));
        }
    // Beyond what was counted it goes on: more power stays worth more, and less than itself.
    QVERIFY(law(180, 1000.0f) > law(180, 100.0f));
    QVERIFY(law(180, 100.0f) < 50.0f);
}

void tst_ownNoiseLaw::tracksAreNoNoise()
{
    std::vector<float> y = noise();
    for (Index frame = 0; frame < frameCount; ++frame)
        for (Index cell = 57; cell <= 63; ++cell)
            y[std::size_t(frame * cells + cell)] *= frame % 8 == 0 ? 30.0f : 1.0f; // keyed: no raised median
    const FrameArray frames = framesOf(std::move(y));
    QVERIFY(OwnNoiseLaw(frames, {}, 2.0, 1.0, {})(70, 20.0f) < 15.0f);
    const Track track = constantTrack(60);
    QCOMPARE(OwnNoiseLaw(frames, std::span(&track, 1), 2.0, 1.0, {})(70, 20.0f), 20.0f);
}

void tst_ownNoiseLaw::aSteadyLineIsNoNoise()
{
    std::vector<float> y = noise();
    for (Index frame = 0; frame < frameCount; ++frame)
        y[std::size_t(frame * cells + 60)] *= 30.0f;
    QCOMPARE(OwnNoiseLaw(framesOf(std::move(y)), {}, 2.0, 1.0, {})(70, 20.0f), 20.0f);
}

void tst_ownNoiseLaw::aFewFramesTellNothing()
{
    std::vector<float> y = noise();
    y.resize(63 * cells);
    const FrameArray frames = framesOf(std::move(y));
    QVERIFY(OwnNoiseLaw(frames, {}, 2.0, 1.0, {}).isAsAssumed());
}

void tst_ownNoiseLaw::runsAreMeasured()
{
    constexpr double rho = 0.8;
    const OwnNoiseLaw law(framesOf(runningNoise(rho)), {}, 2.0, 1.0, {});
    QVERIFY(!law.isAsAssumed());
    QCOMPARE(law(200, 20.0f), 20.0f); // each power by itself is exponential
    for (const Index n : {2, 4, 8, 16, 32}) {
        QCOMPARE(law.runs(60, n), 1.0);
        double variance = 1.0;
        for (Index k = 1; k < n; ++k)
            variance += 2.0 * (1.0 - double(k) / double(n)) * std::pow(rho, 2.0 * double(k));
        // Powers are cut at 5, which takes 1 % of the cells and a little of their likeness.
        QVERIFY2(std::abs(law.runs(200, n) / variance - 1.0) < 0.06,
                 qPrintable(QStringLiteral("%1 frames: %2, not %3").arg(n).arg(law.runs(200, n)).arg(variance)));
    }
    QCOMPARE(law.runs(200, 1), 1.0);
    QVERIFY(law.runs(200, 3) > law.runs(200, 2) && law.runs(200, 3) < law.runs(200, 4));
    QCOMPARE(law.runs(200, 1000), law.runs(200, 32));
    // Overlap that is known of is no finding: 1 + 2ρ² of it are an upper bound for two frames.
    QCOMPARE(OwnNoiseLaw(framesOf(runningNoise(rho)), {}, 2.0, 1.0 + 2.0 * rho * rho, {}).runs(200, 2), 1.0);
}

void tst_ownNoiseLaw::runsBetweenCrowdedTracksTellNothing()
{
    const FrameArray frames = framesOf(runningNoise(0.8));
    // Tracks blind 17 bins each, 10 bins apart in the last part of 40.
    std::vector<Track> tracks;
    for (const Index cell : {208, 228})
        tracks.push_back(constantTrack(cell));
    const OwnNoiseLaw law(frames, tracks, 2.0, 1.0, {});
    QCOMPARE(law.runs(220, 8), 1.0);
    QVERIFY(law.runs(180, 8) > 2.0);
}

void tst_ownNoiseLaw::burstsAreExplainedAndTheLineIsNot()
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.25;
    settings.decide.falseAlarmsPerHour = 60.0;
    const auto analysis = analyse(burstsAndLine(), settings);
    const auto isLine = [&](const Track &track) {
        const TrackPoint &first = track.points.front();
        const double seconds = analysis->time().value(double(first.frame));
        return std::abs(analysis->grid().axes.front().value(double(first.cell)) - 60.0) < 6.0 && seconds > 98.0
               && seconds < 202.0;
    };
    const auto lines = std::count_if(analysis->tracks.begin(), analysis->tracks.end(), isLine);
    QVERIFY(lines >= 1);
    QVERIFY(std::none_of(analysis->explainedByNoise.begin(), analysis->explainedByNoise.end(), isLine));
    // Ten false alarms are ordered; without the comparison there are about a hundred.
    QVERIFY(analysis->explainedByNoise.size() >= 80);
    QVERIFY(std::ssize(analysis->tracks) - lines <= 20);
}

void tst_ownNoiseLaw::swellsAreExplainedAndTheLineIsNot()
{
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.25;
    settings.decide.falseAlarmsPerHour = 60.0;
    const auto analysis = analyse(swellsAndLine(), settings);
    const auto isLine = [&](const Track &track) {
        return std::any_of(track.points.begin(), track.points.end(), [&](const TrackPoint &point) {
            return std::abs(analysis->time().value(double(point.frame)) - 150.0) < 1.0
                   && std::abs(analysis->grid().axes.front().value(double(point.cell)) - 60.0) < 4.0;
        });
    };
    const auto lines = std::count_if(analysis->tracks.begin(), analysis->tracks.end(), isLine);
    QVERIFY(lines >= 1);
    QVERIFY(std::none_of(analysis->explainedByNoise.begin(), analysis->explainedByNoise.end(), isLine));
    // Five false alarms are ordered; without the comparison there are about forty.
    QVERIFY(analysis->explainedByNoise.size() >= 25);
    QVERIFY(std::ssize(analysis->tracks) - lines <= 10);
}

FAINTLINE_TEST(tst_ownNoiseLaw)
#include "tst_ownNoiseLaw.moc"
