#include "refine/ownNoiseLaw.h"
#include "support/test.h"

#include "base/Random.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

/// Noise away from the tracks: which cells are left out, by the definition written out cell by cell, and which bins are
/// taken for noise.
class tst_noiseSample : public QObject
{
    Q_OBJECT

private slots:
    void withoutTracksEverythingCounts();
    void cellsNearATrackAreLeftOut_data();
    void cellsNearATrackAreLeftOut();
    void aLargeRecordingIsSampledInRuns();
    void cellsWithoutPowerAreNotObserved();
    void aBinWithASteadyLineIsNoNoise();
    void aBinThatIsSeldomObservedIsNoNoise();
};

namespace {

std::vector<float> exponential(std::size_t count, std::uint64_t seed)
{
    Random random(seed, 1);
    std::vector<float> y(count);
    for (float &value : y)
        value = float(-std::log(1.0 - random.uniform()));
    return y;
}

FrameArray framesOf(Index frames, Index cells, std::vector<float> y)
{
    return {{"time", "s", 0.0, 1.0, frames, false}, Grid{{{"frequency", "Hz", 0.0, 1.0, cells, false}}}, std::move(y)};
}

/// A line that drifts from cell 30 on.
Track drifting()
{
    Track track;
    for (Index i = 0; i < 40; ++i)
        track.points.push_back({60 + i, 30 + i / 4, 0, 0.0});
    return track;
}

} // namespace

void tst_noiseSample::withoutTracksEverythingCounts()
{
    const std::vector<float> y = exponential(100 * 50, 1);
    const NoiseSample sample(framesOf(100, 50, y), {}, 1.0, {});
    QCOMPARE(sample.rows(), Index(100));
    QCOMPARE(sample.cells(), Index(50));
    for (Index row = 0; row < 100; ++row)
        for (Index cell = 0; cell < 50; ++cell)
            QCOMPARE(sample.at(row, cell), y[std::size_t(row * 50 + cell)]);
}

void tst_noiseSample::cellsNearATrackAreLeftOut_data()
{
    QTest::addColumn<double>("binsPerCell");
    QTest::addColumn<Index>("half"); // four resolution cells
    QTest::newRow("one bin a cell") << 1.0 << Index(4);
    QTest::newRow("one and a half") << 1.5 << Index(6);
    QTest::newRow("three") << 3.0 << Index(12);
}

void tst_noiseSample::cellsNearATrackAreLeftOut()
{
    QFETCH(double, binsPerCell);
    QFETCH(Index, half);
    const Track track = drifting();
    const NoiseSample sample(framesOf(160, 60, exponential(160 * 60, 2)), std::span(&track, 1), binsPerCell, {});
    for (Index frame = 0; frame < 160; ++frame)
        for (Index cell = 0; cell < 60; ++cell) {
            bool isNear = false;
            for (std::size_t i = 0; i < track.points.size(); ++i) {
                const TrackPoint &point = track.points[i];
                const Index before = i == 0 ? 10 : 2, after = i + 1 == track.points.size() ? 10 : 2;
                isNear |= std::abs(cell - point.cell) <= half && frame >= point.frame - before
                          && frame <= point.frame + after;
            }
            QVERIFY2(std::isnan(sample.at(frame, cell)) == isNear,
                     qPrintable(QStringLiteral("frame %1, cell %2").arg(frame).arg(cell)));
        }
}

/// Of 9.6 million cells, one run of three: frames 0 … 31, 96 … 127 and so on.
void tst_noiseSample::aLargeRecordingIsSampledInRuns()
{
    constexpr Index frames = 9600, cells = 1000;
    std::vector<float> y(std::size_t(frames * cells));
    for (std::size_t i = 0; i < y.size(); ++i)
        y[i] = float(Index(i) / cells + 1); // the frame's number
    Track track;
    track.points = {{96, 10, 0, 0.0}, {97, 10, 0, 0.0}};
    const NoiseSample sample(framesOf(frames, cells, std::move(y)), std::span(&track, 1), 1.0, {});
    QCOMPARE(sample.rows(), Index(3200));
    for (Index row = 0; row < sample.rows(); ++row)
        QCOMPARE(sample.at(row, 500), float(row / 32 * 96 + row % 32 + 1));
    QVERIFY(std::isnan(sample.at(32, 10)) && std::isnan(sample.at(32 + 11, 14))); // ten frames after its end
    QVERIFY(!std::isnan(sample.at(32 + 12, 10)) && !std::isnan(sample.at(31, 10)) && !std::isnan(sample.at(32, 15)));
}

void tst_noiseSample::cellsWithoutPowerAreNotObserved()
{
    std::vector<float> y(40 * 2, 1.0f);
    y[3] = 0.0f;
    y[4] = std::nanf("");
    y[5] = -1.0f;
    const NoiseSample sample(framesOf(40, 2, y), {}, 1.0, {});
    for (Index i = 0; i < 80; ++i)
        QCOMPARE(std::isnan(sample.at(i / 2, i % 2)), i >= 3 && i <= 5);
}

void tst_noiseSample::aBinWithASteadyLineIsNoNoise()
{
    std::vector<float> y = exponential(600 * 3, 3);
    for (std::size_t frame = 0; frame < 600; ++frame)
        y[frame * 3 + 1] *= 2.0f; // 3 dB all the time
    const NoiseSample sample(framesOf(600, 3, y), {}, 1.0, {});
    QCOMPARE(sample.noiseIn(0).size(), std::size_t(600));
    QVERIFY(sample.noiseIn(1).empty());
    std::vector<float> expected, found = sample.noiseIn(2);
    for (std::size_t frame = 0; frame < 600; ++frame)
        expected.push_back(y[frame * 3 + 2]);
    std::sort(expected.begin(), expected.end());
    std::sort(found.begin(), found.end());
    QVERIFY(found == expected);
}

void tst_noiseSample::aBinThatIsSeldomObservedIsNoNoise()
{
    std::vector<float> y = exponential(600 * 2, 4);
    for (std::size_t frame = 0; frame < 600; ++frame)
        if (frame % 10 > 0)
            y[frame * 2] = std::nanf(""); // a tenth of the frames remains …
        else
            y[frame * 2 + 1] = std::nanf(""); // … or nine tenths
    const NoiseSample sample(framesOf(600, 2, y), {}, 1.0, {});
    QVERIFY(sample.noiseIn(0).empty());
    QCOMPARE(sample.noiseIn(1).size(), std::size_t(540));
}

FAINTLINE_TEST(tst_noiseSample)
#include "tst_noiseSample.moc"
