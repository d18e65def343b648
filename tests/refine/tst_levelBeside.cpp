#include "base/Random.h"
#include "refine/levelBeside.h"
#include "support/test.h"

#include <algorithm>
#include <limits>
#include <numeric>

using namespace faintline;

namespace {

constexpr double binsPerCell = 2.0;
constexpr double hannLikeness = 35.0 / 18.0; // Hann

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

std::vector<double> pathOf(const PathStrip &strip)
{
    return {strip.centres.begin(), strip.centres.end()};
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
    void noiseIsNotRaised();
    void aCloudIsMeasured();
    void oneSideIsEnough();
    void theLineItselfDoesNotCount();
    void linesBesideDoNotCount();
    void whatWasNotObserved();
    void areasAreFoundWithTheirLevel();
    void onNoiseNoLevelIsRaised();
    void aBurstOfTwoFramesIsAnArea();
    void linesAreNoArea();
    void aNarrowBandIsAnArea();
    void noiseHasNoRuns();
    void runsOfSpeckleAreMeasured();
    void linesAndStepsAreNoRuns();
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

/// Of noise, and beside a line of 20 dB without its leakage, few areas are found; in an area its level, and when it was.
void tst_levelBeside::areasAreFoundWithTheirLevel()
{
    PathStrip strip = noise(400, 5);
    const std::vector<double> path = pathOf(strip);
    QVERIFY2(mean(areaLevels(strip, path, binsPerCell, hannLikeness), 0, 400) < 1.15,
             qPrintable(QString::number(mean(areaLevels(strip, path, binsPerCell, hannLikeness), 0, 400))));
    raise(strip, 200, 400, 1, strip.halfWidth, 4.0f); // on one side
    const std::vector<double> levels = areaLevels(strip, path, binsPerCell, hannLikeness);
    QVERIFY(mean(levels, 0, 190) < 1.3);
    const double inside = mean(levels, 210, 400);
    QVERIFY2(inside > 3.5 && inside < 4.8, qPrintable(QString::number(inside)));
}

/// The mean logarithm of the levels of noise, whatever the number of frames.
void tst_levelBeside::onNoiseNoLevelIsRaised()
{
    for (const Index frames : {50, 400, 4000}) {
        double sum = 0.0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            const PathStrip strip = noise(frames, seed);
            for (const double level : areaLevels(strip, pathOf(strip), binsPerCell, hannLikeness))
                sum += std::log(level) / (20.0 * double(frames));
        }
        QVERIFY2(sum < 0.01, qPrintable(QString("%1 of %2 frames").arg(sum).arg(frames)));
    }
}

/// Of 12 dB beside the path, anywhere in 200 frames, and not in the others.
void tst_levelBeside::aBurstOfTwoFramesIsAnArea()
{
    double inside = 0.0;
    double outside = 0.0;
    for (Index seed = 1; seed <= 20; ++seed) {
        PathStrip strip = noise(200, std::uint64_t(seed));
        const Index first = 9 * seed;
        raise(strip, first, first + 2, -strip.halfWidth, strip.halfWidth, 16.0f);
        std::vector<double> levels = areaLevels(strip, pathOf(strip), binsPerCell, hannLikeness);
        for (double &level : levels)
            level = std::log(level);
        inside += mean(levels, first, first + 2) / 20.0;
        outside += (mean(levels, 0, first) + mean(levels, first + 2, 200)) / 40.0;
    }
    QVERIFY2(inside > std::log(10.0), qPrintable(QString::number(inside)));
    QVERIFY2(outside < 0.03, qPrintable(QString::number(outside)));
}

/// A line next to the path, 4 of the 10 bins on that side. Of the other 6, the lowest 5 are those below 1.79 (5 of 6):
/// their level is 0.64 + 1.79.
void tst_levelBeside::linesAreNoArea()
{
    PathStrip strip = noise(400, 6);
    raise(strip, 0, 400, 5, 8, 100.0f);
    const double level = mean(areaLevels(strip, pathOf(strip), binsPerCell, hannLikeness), 0, 400);
    QVERIFY2(level < 2.5, qPrintable(QString::number(level)));
}

/// Eight cells around the path: most cells beyond 2.5 are noise, but those next to it are not.
void tst_levelBeside::aNarrowBandIsAnArea()
{
    PathStrip strip = noise(400, 7);
    raise(strip, 0, 400, -8, 8, 4.0f);
    const double level = mean(areaLevels(strip, pathOf(strip), binsPerCell, hannLikeness), 0, 400);
    QVERIFY2(level > 3.5 && level < 4.8, qPrintable(QString::number(level)));
}

/// V(n) beside a path, for bins that are independent of each other.
static double runsOf(const PathStrip &strip, Index n)
{
    return runsBeside(strip, pathOf(strip), n, binsPerCell, 1.0 / binsPerCell, 1.0);
}

/// The lower end of an interval of two standard errors: 2.3 % of the values of one length are above 1.
void tst_levelBeside::noiseHasNoRuns()
{
    for (const Index frames : {20, 100, 1000}) {
        int above = 0;
        for (std::uint64_t seed = 1; seed <= 200; ++seed)
            above += runsOf(noise(frames, seed), 2) > 1.0 ? 1 : 0;
        QVERIFY2(above <= 14, qPrintable(QString("%1 of 200, %2 frames").arg(above).arg(frames)));
    }
}

/// Power that stays for `stay` frames: means over n = stay, 2 stay … have a variance of stay/n.
void tst_levelBeside::runsOfSpeckleAreMeasured()
{
    for (const Index stay : {4, 16}) {
        PathStrip strip = noise(4000, std::uint64_t(stay));
        for (Index at = 0; at < 4000; ++at)
            std::copy_n(strip.row(at / stay * stay), strip.width(), strip.row(at));
        for (const Index n : {stay, Index(32)}) {
            const double pairs = 18.0 * 4000.0 / (1.5 * double(n));
            const double interval = 1.0 + 2.0 * 2.33 / std::sqrt(pairs);
            const double runs = runsOf(strip, n);
            QVERIFY2(runs < 1.1 * double(stay) && runs > 0.9 * double(stay) / (interval * interval),
                     qPrintable(QString("%1 for %2 of %3").arg(runs).arg(n).arg(stay)));
        }
    }
}

/// A line beside the path, a step of 6 dB, and a line that crosses it.
void tst_levelBeside::linesAndStepsAreNoRuns()
{
    PathStrip line = noise(300, 8);
    raise(line, 0, 300, 6, 9, 100.0f);
    QVERIFY2(runsOf(line, 32) < 1.3, qPrintable(QString::number(runsOf(line, 32))));
    PathStrip step = noise(300, 9);
    raise(step, 150, 300, -step.halfWidth, step.halfWidth, 4.0f);
    QVERIFY2(runsOf(step, 32) < 1.3, qPrintable(QString::number(runsOf(step, 32))));
    PathStrip crossing = noise(300, 10);
    for (Index bin = 1 - crossing.halfWidth; bin < crossing.halfWidth; ++bin)
        raise(crossing, 150 + bin, 151 + bin, bin - 1, bin + 1, 100.0f);
    QVERIFY2(runsOf(crossing, 32) < 2.0, qPrintable(QString::number(runsOf(crossing, 32))));
}

FAINTLINE_TEST(tst_levelBeside)
#include "tst_levelBeside.moc"
