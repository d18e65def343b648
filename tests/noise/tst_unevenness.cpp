#include "noise/unevenness.h"
#include "support/test.h"

#include "base/Random.h"

#include <cmath>

using namespace faintline;

namespace {

constexpr Index tileFrames = Unevenness::tileFrames;
constexpr Index tileCells = Unevenness::tileCells;

/// Frames of tiles each of which has one value throughout: rows of tiles in time, columns along frequency.
std::vector<float> tiled(const std::vector<std::vector<float>> &tiles, Index frames, Index cells)
{
    std::vector<float> values;
    for (Index frame = 0; frame < frames; ++frame)
        for (Index cell = 0; cell < cells; ++cell)
            values.push_back(tiles[std::size_t(frame / tileFrames)][std::size_t(cell / tileCells)]);
    return values;
}

std::vector<float> ones(Index count)
{
    return std::vector<float>(std::size_t(count), 1.0f);
}

} // namespace

/// How much noise changes with time: tiles of known values by hand, steady noise by its own law.
class tst_unevenness : public QObject
{
    Q_OBJECT

private slots:
    // Means 1, 2 and 4 in one column, all alike in the other.
    void tilesByHand()
    {
        const Index cells = 2 * tileCells;
        const Index frames = 3 * tileFrames;
        const Unevenness found =
            unevenness(tiled({{1.0f, 3.0f}, {2.0f, 3.0f}, {4.0f, 3.0f}}, frames, cells), ones(cells), ones(frames));
        const double ln2 = std::log(2.0);
        QVERIFY(std::abs(found.sum - 2.0 * ln2 * ln2) < 1e-6);                  // -ln 2, 0, ln 2 about their mean
        QVERIFY(std::abs(found.sumOfMeans - (16.0 + 1.0 + 25.0) / 9.0) < 1e-6); // about 7/3
        QCOMPARE(found.freedom, 4.0);
        QVERIFY(std::abs(found.variance() - 0.5 * ln2 * ln2) < 1e-6);
        QVERIFY(std::abs(found.varianceOfMeans() - 42.0 / 36.0) < 1e-6);
    }

    void factorsAreDividedOut()
    {
        const Index cells = 2 * tileCells;
        const Index frames = 4 * tileFrames;
        std::vector<float> values;
        std::vector<float> ofCell;
        std::vector<float> ofFrame;
        for (Index cell = 0; cell < cells; ++cell)
            ofCell.push_back(std::exp(-0.1f * float(cell)));
        for (Index frame = 0; frame < frames; ++frame)
            ofFrame.push_back(1.0f / float(frame + 1));
        for (Index frame = 0; frame < frames; ++frame)
            for (Index cell = 0; cell < cells; ++cell)
                values.push_back(float(frame + 1) * std::exp(0.1f * float(cell)));
        const Unevenness found = unevenness(values, ofCell, ofFrame);
        QVERIFY(found.variance() < 1e-9 && found.varianceOfMeans() < 1e-9);
        QVERIFY(unevenness(values, ofCell, ones(frames)).variance() > 0.01);
    }

    // A line of any strength counts as five times the noise.
    void strongCellsAreCutOff()
    {
        const Index frames = 2 * tileFrames;
        std::vector<float> values = ones(frames * tileCells);
        for (Index frame = 0; frame < tileFrames; ++frame)
            values[std::size_t(frame * tileCells + 3)] = 1e6f;
        const double louder = 1.0 + 4.0 / double(tileCells);
        const Unevenness found = unevenness(values, ones(tileCells), ones(frames));
        QVERIFY(std::abs(found.sumOfMeans - 0.5 * (louder - 1.0) * (louder - 1.0)) < 1e-9);
        QVERIFY(std::abs(found.sum - 0.5 * std::log(louder) * std::log(louder)) < 1e-9);
    }

    void restsOfTilesDoNotCount()
    {
        const Index cells = tileCells + 5;
        const Index frames = 2 * tileFrames + 3;
        std::vector<float> values = ones(frames * cells);
        for (Index frame = 0; frame < frames; ++frame)
            for (Index cell = 0; cell < cells; ++cell)
                if (frame >= 2 * tileFrames || cell >= tileCells)
                    values[std::size_t(frame * cells + cell)] = float(frame);
        const Unevenness found = unevenness(values, ones(cells), ones(frames));
        QCOMPARE(found.freedom, 1.0);
        QCOMPARE(found.sum, 0.0);
        QCOMPARE(unevenness(ones(frames * 5), ones(5), ones(frames)).freedom, 0.0); // narrower than a tile
        QCOMPARE(unevenness(ones(7 * cells), ones(cells), ones(7)).variance(), 0.0);
    }

    void silenceDoesNotCount()
    {
        const Index frames = 3 * tileFrames;
        const Unevenness found =
            unevenness(tiled({{1.0f}, {0.0f}, {4.0f}}, frames, tileCells), ones(tileCells), ones(frames));
        QCOMPARE(found.freedom, 1.0);
        const double ln4 = std::log(4.0);
        QVERIFY(std::abs(found.sum - 0.5 * ln4 * ln4) < 1e-6);
        QCOMPARE(unevenness(tiled({{1.0f}, {0.0f}}, 2 * tileFrames, tileCells), ones(tileCells), ones(2 * tileFrames))
                     .freedom,
                 0.0); // one tile changes nothing
    }

    // A tile's mean of 192 exponentials: its logarithm varies by 1/192, a little less as strong ones are cut off.
    void steadyNoiseVariesByItsLaw()
    {
        const Index cells = 40 * tileCells;
        const Index frames = 20 * tileFrames;
        std::vector<float> values(std::size_t(frames * cells));
        Random(31, 0).exponentials(values);
        const Unevenness found = unevenness(values, ones(cells), ones(frames));
        QCOMPARE(found.freedom, 40.0 * 19.0);
        // min(Exp, 5): mean 1 - e^-5, second moment 2 - 12 e^-5.
        const double tail = std::exp(-5.0);
        const double mean = 1.0 - tail;
        const double variance = 2.0 - 12.0 * tail - mean * mean;
        const double expected = variance / double(tileFrames * tileCells);
        const double error = std::sqrt(2.0 / found.freedom); // of a variance
        QVERIFY(std::abs(found.varianceOfMeans() / expected - 1.0) < 4.5 * error);
        QVERIFY(std::abs(found.variance() / (expected / (mean * mean)) - 1.0) < 4.5 * error);
        QCOMPARE(Unevenness::ofNoise(1.0), 1.0 / 192.0);
        QCOMPARE(Unevenness::ofNoise(2.0), 2.0 / 192.0);
        QVERIFY(std::abs(found.variance() / Unevenness::ofNoise(1.0) - 1.0) < 0.25);
    }

    // Each frame over its row and its own common level, the last of bands + 1 levels.
    void changesAreTakenOverTheBackground()
    {
        const Index cells = tileCells;
        const Index frames = 3 * tileFrames;
        BlockBackground block;
        block.lnPower.assign(std::size_t(cells), std::log(2.0f));
        std::vector<float> levels;
        std::vector<float> values;
        for (Index frame = 0; frame < frames; ++frame) {
            const float level = frame < tileFrames ? 0.0f : std::log(3.0f);
            for (const float one : {7.0f, -7.0f, level}) // two sub-bands, which are another matter
                levels.push_back(one);
            const float tile = frame < 2 * tileFrames ? 1.0f : 1.5f;
            for (Index cell = 0; cell < cells; ++cell)
                values.push_back(2.0f * std::exp(level) * tile);
        }
        const Unevenness found = changesOf(values, block, levels, 2);
        QVERIFY(std::abs(found.sumOfMeans - (0.25 * 2.0 / 3.0) * 1.0) < 1e-5); // 1, 1, 1½
        QCOMPARE(found.freedom, 2.0);
    }
};

FAINTLINE_TEST(tst_unevenness)
#include "tst_unevenness.moc"
