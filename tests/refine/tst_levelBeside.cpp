#include "base/Random.h"
#include "refine/levelBeside.h"
#include "support/test.h"

#include <algorithm>
#include <limits>
#include <numeric>

using namespace faintline;

namespace {

constexpr double binsPerCell = 2.0;

/// Noise of mean 1 beside a path that moves by a bin every second frame.
PathStrip noise(Index frames, std::uint64_t seed)
{
    PathStrip strip;
    strip.halfWidth = levelBesideHalfWidth(binsPerCell);
    for (Index at = 0; at < frames; ++at)
        strip.centres.push_back(100 + at / 2);
    Random random(seed, 0);
    strip.y.resize(std::size_t(frames * strip.width()));
    for (float &y : strip.y)
        y = float(random.exponential());
    return strip;
}

/// Raises the bins of the strip from..to, counted from the path, in some of its frames.
void raise(PathStrip &strip, Index firstFrame, Index endFrame, Index from, Index to, float factor)
{
    for (Index at = firstFrame; at < endFrame; ++at)
        for (Index bin = from; bin <= to; ++bin)
            strip.row(at)[strip.halfWidth + bin] *= factor;
}

double mean(const std::vector<double> &values, Index from, Index to)
{
    return std::accumulate(values.begin() + from, values.begin() + to, 0.0) / double(to - from);
}

} // namespace

/// What a path runs through, on strips of known levels.
class tst_levelBeside : public QObject
{
    Q_OBJECT

private slots:
    void sidesOfALineAreNoise();
    void sidesOfABandAreRaised();
    void sidesHardlyDependOnSingleCells();
    void shareOfSidesOfALine();
    void shareOfSidesOfABurstyBand();
    void shareOfSidesNeedsBoth();
    void noiseIsNotRaised();
    void aCloudIsMeasured();
    void oneSideIsEnough();
    void theLineItselfDoesNotCount();
    void linesBesideDoNotCount();
    void whatWasNotObserved();
};

void tst_levelBeside::noiseIsNotRaised()
{
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const std::vector<double> levels = levelBeside(noise(200, seed), binsPerCell);
        QVERIFY(*std::min_element(levels.begin(), levels.end()) >= 1.0);
        sum += mean(levels, 0, 200) / 20.0;
    }
    QVERIFY2(sum < 1.05, qPrintable(QString::number(sum)));
}

void tst_levelBeside::aCloudIsMeasured()
{
    PathStrip strip = noise(300, 1);
    raise(strip, 100, 200, -strip.halfWidth, strip.halfWidth, 4.0f);
    const std::vector<double> levels = levelBeside(strip, binsPerCell);
    const double inside = mean(levels, 110, 190);
    QVERIFY2(inside > 2.7 && inside < 5.0, qPrintable(QString::number(inside)));
    QVERIFY(mean(levels, 0, 25) < 1.2);
    QVERIFY(mean(levels, 275, 300) < 1.2);
}

void tst_levelBeside::oneSideIsEnough()
{
    PathStrip strip = noise(300, 2);
    raise(strip, 0, 300, 1, strip.halfWidth, 4.0f); // the path runs along the cloud's edge
    QVERIFY(mean(levelBeside(strip, binsPerCell), 0, 300) > 2.5);
}

void tst_levelBeside::theLineItselfDoesNotCount()
{
    PathStrip strip = noise(200, 3);
    raise(strip, 0, 200, -4, 4, 1e4f); // its main lobe, two resolution cells on either side
    QVERIFY(mean(levelBeside(strip, binsPerCell), 0, 200) < 1.1);
}

void tst_levelBeside::linesBesideDoNotCount()
{
    PathStrip strip = noise(200, 4);
    raise(strip, 0, 200, 7, 10, 100.0f);
    raise(strip, 0, 200, -10, -7, 100.0f);
    const double level = mean(levelBeside(strip, binsPerCell), 0, 200);
    QVERIFY2(level < 2.1, qPrintable(QString::number(level))); // not a hundred: 35 of the 60 % that are noise
}

void tst_levelBeside::whatWasNotObserved()
{
    PathStrip strip = noise(50, 5);
    std::fill(strip.y.begin(), strip.y.end(), std::numeric_limits<float>::quiet_NaN());
    for (const double level : levelBeside(strip, binsPerCell))
        QCOMPARE(level, 1.0);
}

/// Even beside a line of 20 dB with its main lobe, known or not to the last bin.
void tst_levelBeside::sidesOfALineAreNoise()
{
    PathStrip strip = noise(400, 5);
    raise(strip, 0, 400, -2, 2, 100.0f);
    const double level = levelOfSides(strip, binsPerCell);
    QVERIFY2(level >= 1.0 && level < 1.1, qPrintable(QString::number(level)));
}

/// The larger side counts.
void tst_levelBeside::sidesOfABandAreRaised()
{
    PathStrip strip = noise(400, 6);
    raise(strip, 0, 400, 0, 8, 2.5f);
    QVERIFY(std::abs(levelOfSides(strip, binsPerCell) - 2.5) < 0.2);
    for (Index at = 0; at < strip.frameCount(); ++at) // what is not observed does not count
        for (Index bin = 1; bin <= 8; ++bin)
            strip.row(at)[strip.halfWidth + bin] = std::numeric_limits<float>::quiet_NaN();
    QVERIFY(levelOfSides(strip, binsPerCell) < 1.1);
}

/// A signal that crosses the side in one frame of twenty, 30 dB above the noise.
void tst_levelBeside::sidesHardlyDependOnSingleCells()
{
    PathStrip strip = noise(400, 7);
    for (Index at = 0; at < 400; at += 20)
        raise(strip, at, at + 1, 3, 7, 1000.0f);
    QVERIFY(levelOfSides(strip, binsPerCell) < 1.5); // the mean would be 51
}

void tst_levelBeside::shareOfSidesOfALine()
{
    PathStrip strip = noise(400, 8);
    raise(strip, 0, 400, -2, 2, 3.0f);
    const double share = shareOfSides(strip, strip, binsPerCell);
    QVERIFY2(share < 0.1, qPrintable(QString::number(share)));
}

/// 20 dB in one frame of twenty: on average the sides are as high as the path, but levelOfSides hardly rises.
void tst_levelBeside::shareOfSidesOfABurstyBand()
{
    PathStrip strip = noise(400, 9);
    for (Index at = 0; at < 400; at += 20)
        raise(strip, at, at + 1, -7, 7, 100.0f);
    QVERIFY(levelOfSides(strip, binsPerCell) < 1.5);
    const double share = shareOfSides(strip, strip, binsPerCell);
    QVERIFY2(share > 0.5 && share < 2.0, qPrintable(QString::number(share)));
}

/// A stronger signal on one side, or one that is known, is not a wider band.
void tst_levelBeside::shareOfSidesNeedsBoth()
{
    PathStrip line = noise(400, 10);
    raise(line, 0, 400, 0, 8, 3.0f);
    QVERIFY(shareOfSides(line, line, binsPerCell) < 0.1);
    raise(line, 0, 400, -8, -1, 3.0f);
    QVERIFY(shareOfSides(line, line, binsPerCell) > 0.8);
    PathStrip sides = line;
    for (Index at = 0; at < sides.frameCount(); ++at)
        for (Index bin = 1; bin <= 8; ++bin)
            sides.row(at)[sides.halfWidth + bin] = std::numeric_limits<float>::quiet_NaN();
    QCOMPARE(shareOfSides(line, sides, binsPerCell), 0.0);
}

FAINTLINE_TEST(tst_levelBeside)
#include "tst_levelBeside.moc"
