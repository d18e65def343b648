#include "noise/blockBackground.h"
#include "support/test.h"

#include "base/Random.h"
#include "noise/NoiseBackground.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

constexpr Index cells = 400;

/// Exponential noise of a mean for each cell.
template <class Mean>
std::vector<float> noise(Index frames, std::uint64_t stream, Mean mean)
{
    std::vector<float> values(std::size_t(frames * cells));
    Random(81, stream).exponentials(values);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] *= float(mean(Index(i) % cells));
    return values;
}

double flat(Index)
{
    return 1.0;
}

double meanOf(const std::vector<float> &values)
{
    double sum = 0.0;
    for (const float value : values)
        sum += double(value);
    return sum / double(values.size());
}

} // namespace

/// What one block says about its noise: by the law of exponential cells, and against plain loops.
class tst_blockBackground : public QObject
{
    Q_OBJECT

private slots:
    void ratiosOfMedians()
    {
        QCOMPARE(mostNoiseRatio(1.0), 6.0);
        QCOMPARE(mostNoiseRatio(25.0), 2.0);
        QVERIFY(mostNoiseRatio(1e12) < 1.00001);
    }

    // Mean of value over median of the neighbours that are within the ratio either way.
    void refinedMeansAreThoseOfTheNeighbours()
    {
        constexpr Index half = 7;
        constexpr double most = 3.0;
        std::vector<float> values;
        std::vector<float> medians;
        Random random(82, 0);
        for (Index i = 0; i < 80; ++i) {
            medians.push_back(float(0.01 * double(i)));
            values.push_back(medians.back() + float(1.6 * (random.uniform() - 0.5)));
            if (i % 9 == 0)
                values.back() += 4.0f; // a line
            if (i % 13 == 0)
                values.back() -= 4.0f; // an empty cell
        }
        std::vector<float> refined = medians;
        const std::vector<bool> isNoise = refine(values, refined, half, most);
        for (Index cell = 0; cell < 80; ++cell) {
            double sum = 0.0;
            double count = 0.0;
            for (Index other = std::max<Index>(0, cell - half); other <= std::min<Index>(79, cell + half); ++other) {
                const double ratio = std::exp(double(values[std::size_t(other)]) - double(medians[std::size_t(other)]));
                if (ratio < most && ratio > 1.0 / most) {
                    sum += ratio;
                    count += 1.0;
                }
            }
            const double own = std::exp(double(values[std::size_t(cell)] - medians[std::size_t(cell)]));
            QCOMPARE(bool(isNoise[std::size_t(cell)]), own < most && own > 1.0 / most);
            QVERIFY(count >= 3.0);
            QVERIFY(std::abs(double(refined[std::size_t(cell)]) - double(medians[std::size_t(cell)])
                             - std::log(sum / count))
                    < 1e-5);
        }
    }

    void whiteNoiseIsKnownInTheMean()
    {
        double sum = 0.0;
        constexpr int blocks = 20;
        for (std::uint64_t block = 0; block < blocks; ++block) {
            const BlockBackground found = blockBackground({noise(48, block, flat), cells}, 24);
            sum += meanOf(found.lnPower);
            // A factor of 1.72 either way is 2.6 standard errors of the logarithm of a median of 48.
            QVERIFY(std::count(found.isNoise.begin(), found.isNoise.end(), true) > cells - 15);
            QVERIFY(found.isFirm == found.isNoise);
            for (Index cell = 24; cell < cells - 24; ++cell) // where the window is not continued
                QVERIFY(std::abs(found.lnPower[std::size_t(cell)]) < 0.2f);
        }
        // A median's logarithm scatters by 1.44/√48; over 400 cells of 20 blocks by a hundredth of that.
        QVERIFY2(std::abs(sum / blocks) < 0.012, qPrintable(QString::number(sum / blocks)));
    }

    void aSlopeIsFollowed()
    {
        const auto slope = [](Index cell) { return std::exp(0.02 * double(cell)); };
        const BlockBackground found = blockBackground({noise(200, 30, slope), cells}, 24);
        double sum = 0.0;
        for (Index cell = 0; cell < cells; ++cell) {
            const double off = double(found.lnPower[std::size_t(cell)]) - 0.02 * double(cell);
            const bool isInside = cell >= 24 && cell < cells - 24;
            QVERIFY2(std::abs(off) < (isInside ? 0.12 : 0.25), qPrintable(QString("cell %1: %2").arg(cell).arg(off)));
            sum += off;
        }
        QVERIFY(std::abs(sum / cells) < 0.02);
    }

    // Twenty times the noise all through the block: it is told, and its neighbours' noise is what it was.
    void aLineIsNoNoise()
    {
        const auto with = [](Index cell) { return cell == 200 ? 20.0 : 1.0; };
        const BlockBackground without = blockBackground({noise(100, 31, flat), cells}, 24);
        const BlockBackground found = blockBackground({noise(100, 31, with), cells}, 24);
        QVERIFY(without.isNoise[200] && !found.isNoise[200] && !found.isFirm[200]);
        QVERIFY(std::abs(double(found.medians[200] - without.medians[200]) - std::log(20.0)) < 1e-4);
        for (Index cell = 0; cell < cells; ++cell)
            QVERIFY(std::abs(found.lnPower[std::size_t(cell)] - without.lnPower[std::size_t(cell)]) < 0.03f);
    }

    // Of one frame the cell is its own median, and of two the lower one; both are corrected in the mean.
    void fewFrames()
    {
        for (const Index frames : {1, 2}) {
            std::vector<float> values;
            for (Index frame = 0; frame < frames; ++frame)
                values.insert(values.end(), std::size_t(cells), frame == 0 ? 3.0f : 9.0f);
            const BlockBackground found = blockBackground({values, cells}, 24);
            const double expected =
                frames == 1 ? std::log(3.0) : std::log(3.0 / 0.5); // the lower of two has a mean of ½
            for (const float median : found.medians)
                QVERIFY(std::abs(double(median) - expected) < 1e-5);
        }
    }

    void silentFramesDoNotCount()
    {
        const std::vector<float> frames = noise(40, 32, flat);
        std::vector<float> withSilence;
        for (Index frame = 0; frame < 40; ++frame) {
            withSilence.insert(withSilence.end(), std::size_t(cells), 0.0f);
            withSilence.insert(withSilence.end(), frames.begin() + frame * cells, frames.begin() + (frame + 1) * cells);
        }
        const BlockBackground a = blockBackground({frames, cells}, 24);
        const BlockBackground b = blockBackground({withSilence, cells}, 24);
        QVERIFY(a.lnPower == b.lnPower && a.medians == b.medians && a.isNoise == b.isNoise);
    }

    void silenceAllOver()
    {
        const BlockBackground found = blockBackground({std::vector<float>(std::size_t(10 * cells), 0.0f), cells}, 24);
        QVERIFY(std::all_of(found.lnPower.begin(), found.lnPower.end(),
                            [](float ln) { return ln == NoiseBackground::silence; }));
        QVERIFY(std::find(found.isNoise.begin(), found.isNoise.end(), false) == found.isNoise.end());
    }

    // 10⁻¹³ of the strongest cell is the transform's own error.
    void roundingIsNoNoise()
    {
        const auto band = [](Index cell) { return cell < 200 ? 1.0 : 1e-18; };
        const std::vector<float> frames = noise(100, 33, band);
        const BlockBackground found = blockBackground({frames, cells}, 24);
        const double floor = std::log(double(*std::max_element(frames.begin(), frames.end())) * 1e-13);
        for (Index cell = 240; cell < cells; ++cell) {
            QVERIFY(std::abs(double(found.lnPower[std::size_t(cell)]) - floor) < 1e-4);
            QVERIFY(!found.isNoise[std::size_t(cell)] && !found.isFirm[std::size_t(cell)]);
        }
        QVERIFY(std::count(found.isFirm.begin(), found.isFirm.begin() + 160, true) > 155);
    }

    void flattenedFramesHaveOneLevel()
    {
        std::vector<float> frames = noise(60, 34, [](Index cell) { return 1.0 + double(cell % 7); });
        for (Index frame = 10; frame < 15; ++frame)
            for (Index cell = 0; cell < cells; ++cell)
                frames[std::size_t(frame * cells + cell)] *= 8.0f;
        const std::vector<float> changed = frames;
        BlockMedians medians(frames, cells);
        const std::vector<float> taken = flatten(frames, cells, medians);
        QCOMPARE(taken.size(), std::size_t(60));
        QVERIFY(medians.ofCells == BlockMedians(frames, cells).ofCells);
        for (Index frame = 0; frame < 60; ++frame) {
            const float ln = taken[std::size_t(frame)];
            const bool isLoud = frame >= 10 && frame < 15;
            QVERIFY2(isLoud ? std::abs(ln - std::log(8.0f)) < 0.35f : ln == 0.0f, // 1.44/√400 · 4.5
                     qPrintable(QString("frame %1: %2").arg(frame).arg(double(ln))));
            for (Index cell = 0; cell < cells; ++cell) {
                const auto i = std::size_t(frame * cells + cell);
                QVERIFY(std::abs(frames[i] - changed[i] * std::exp(-ln)) <= 1e-5f * changed[i]);
            }
        }
    }

    void steadyNoiseIsLeftAlone()
    {
        std::vector<float> frames = noise(300, 35, flat);
        const std::vector<float> before = frames;
        BlockMedians medians(frames, cells);
        const std::vector<float> taken = flatten(frames, cells, medians);
        QVERIFY(std::count(taken.begin(), taken.end(), 0.0f) >= 299); // beyond 4.5 errors hardly ever
        for (Index frame = 0; frame < 300; ++frame) {
            const auto row = frames.begin() + frame * cells;
            if (taken[std::size_t(frame)] == 0.0f)
                QVERIFY(std::equal(row, row + cells, before.begin() + frame * cells));
        }
    }

    void flatteningSilence()
    {
        std::vector<float> silent(std::size_t(5 * cells), 0.0f);
        BlockMedians none(silent, cells);
        QCOMPARE(flatten(silent, cells, none), std::vector<float>(5, 0.0f));
        std::vector<float> frames = noise(20, 36, flat);
        std::fill_n(frames.begin() + 3 * cells, cells, 0.0f);
        BlockMedians medians(frames, cells);
        const std::vector<float> taken = flatten(frames, cells, medians);
        QCOMPARE(taken[3], 0.0f);
        QVERIFY(std::all_of(frames.begin() + 3 * cells, frames.begin() + 4 * cells, [](float y) { return y == 0.0f; }));
    }
};

FAINTLINE_TEST(tst_blockBackground)
#include "tst_blockBackground.moc"
