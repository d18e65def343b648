#include "noise/averageWhileSteady.h"
#include "support/test.h"

#include "base/Random.h"

#include <algorithm>
#include <cmath>

using namespace faintline;

namespace {

constexpr Index cells = 240;
constexpr Index half = 20;
constexpr double framesUsed = 48.0;

/// Blocks of medians that scatter as those of 48 frames do, each about a level of its own; and the levels as rows.
struct Blocks {
    std::vector<float> columns;
    std::vector<float> rows;

    Blocks(const std::vector<float> &levels, std::uint64_t stream)
    {
        Random random(111, stream);
        for (const float level : levels)
            for (Index cell = 0; cell < cells; ++cell) {
                rows.push_back(level);
                columns.push_back(level + float(1.4427 / std::sqrt(framesUsed) * random.normal()));
            }
    }

    std::vector<float> averaged() const
    {
        std::vector<float> result = columns;
        averageWhileSteady(result, rows, cells, half, framesUsed);
        return result;
    }
};

bool isSameBlock(const std::vector<float> &a, const std::vector<float> &b, Index block)
{
    return std::equal(a.begin() + block * cells, a.begin() + (block + 1) * cells, b.begin() + block * cells);
}

double scatterOf(const std::vector<float> &values, Index block, double level)
{
    double squares = 0.0;
    for (Index cell = half; cell < cells - half; ++cell)
        squares += std::pow(double(values[std::size_t(block * cells + cell)]) - level, 2.0);
    return std::sqrt(squares / double(cells - 2 * half));
}

} // namespace

/// How far a block's background is averaged with its neighbours': as far as the noise keeps its colour.
class tst_averageWhileSteady : public QObject
{
    Q_OBJECT

private slots:
    void steadyNoiseIsKnownBetter()
    {
        const std::vector<float> many = Blocks(std::vector<float>(13, 2.0f), 1).averaged();
        const std::vector<float> one = Blocks({2.0f}, 1).averaged();
        QVERIFY2(scatterOf(many, 6, 2.0) < 0.6 * scatterOf(one, 0, 2.0),
                 qPrintable(QString("%1, %2").arg(scatterOf(many, 6, 2.0)).arg(scatterOf(one, 0, 2.0))));
        QVERIFY(scatterOf(many, 6, 2.0) < 0.05);
    }

    void sixBlocksEitherWay()
    {
        const Blocks steady(std::vector<float>(20, 0.0f), 2);
        const std::vector<float> before = steady.averaged();
        Blocks changed = steady;
        for (Index cell = 0; cell < cells; ++cell)
            changed.columns[std::size_t(10 * cells + cell)] += 0.1f;
        const std::vector<float> after = changed.averaged();
        for (Index block = 0; block < 20; ++block)
            QCOMPARE(isSameBlock(before, after, block), std::abs(block - 10) > 6);
    }

    // More than a factor of e: what lies beyond it is of no account, however alike.
    void aStepEndsTheAverage()
    {
        const Blocks stepped({0.0f, 0.0f, 0.0f, 1.5f, 0.0f, 0.0f}, 3);
        const std::vector<float> before = stepped.averaged();
        Blocks changed = stepped;
        for (Index cell = 0; cell < cells; ++cell)
            changed.columns[std::size_t(4 * cells + cell)] += 0.1f;
        const std::vector<float> after = changed.averaged();
        for (const Index block : {0, 1, 2, 3})
            QVERIFY(isSameBlock(before, after, block));
        QVERIFY(!isSameBlock(before, after, 4) && !isSameBlock(before, after, 5));
    }

    void aSmallLevelIsTakenOut()
    {
        const std::vector<float> found = Blocks({0.0f, 0.8f, 0.0f, 0.8f, 0.0f, 0.8f, 0.0f}, 4).averaged();
        const std::vector<float> one = Blocks({0.0f}, 4).averaged();
        for (const Index block : {2, 3, 4}) {
            const double level = block % 2 == 0 ? 0.0 : 0.8;
            QVERIFY(scatterOf(found, block, level) < 0.75 * scatterOf(one, 0, 0.0));
        }
    }

    // In half of the band the colour changes by 0.9 after the third block: those cells keep to their own three.
    void aCellThatChangesIsAveragedNoFarther()
    {
        Blocks coloured(std::vector<float>(6, 0.0f), 5);
        for (Index block = 3; block < 6; ++block)
            for (Index cell = 140; cell < cells; ++cell) {
                coloured.rows[std::size_t(block * cells + cell)] += 0.9f;
                coloured.columns[std::size_t(block * cells + cell)] += 0.9f;
            }
        const std::vector<float> found = coloured.averaged();
        for (Index block = 0; block < 6; ++block) {
            double low = 0.0;
            double high = 0.0;
            for (Index i = 0; i < 60; ++i) {
                low += double(found[std::size_t(block * cells + 40 + i)]) / 60.0;
                high += double(found[std::size_t(block * cells + 170 + i)]) / 60.0;
            }
            QVERIFY2(std::abs(low) < 0.06, qPrintable(QString::number(low)));
            QVERIFY2(std::abs(high - (block < 3 ? 0.0 : 0.9)) < 0.06, qPrintable(QString::number(high)));
        }
    }

    // A line that goes from cell to cell raises none of them.
    void linesDoNotCount()
    {
        const Blocks steady(std::vector<float>(9, 0.0f), 6);
        Blocks crossed = steady;
        for (Index block = 0; block < 9; ++block)
            crossed.columns[std::size_t(block * cells + 100 + block)] = 5.0f;
        const std::vector<float> before = steady.averaged();
        const std::vector<float> after = crossed.averaged();
        for (std::size_t i = 0; i < before.size(); ++i)
            QVERIFY(std::abs(after[i] - before[i]) < 0.05f);
    }

    void theLatestIsTheLastOfAll()
    {
        for (const std::size_t count : {1u, 2u, 7u, 12u}) {
            const Blocks blocks(std::vector<float>(count, 1.0f), 7);
            const std::vector<float> all = blocks.averaged();
            const std::vector<float> latest = averageOfLatest(blocks.columns, blocks.rows, cells, half, framesUsed);
            QVERIFY(std::equal(latest.begin(), latest.end(), all.end() - cells));
        }
    }

    void nothingToAverage()
    {
        std::vector<float> none;
        averageWhileSteady(none, {}, cells, half, framesUsed);
        QVERIFY(none.empty());
        Blocks flat({0.5f}, 8);
        flat.columns = flat.rows;
        for (const float value : flat.averaged())
            QVERIFY(std::abs(value - 0.5f) < 1e-6f);
    }
};

FAINTLINE_TEST(tst_averageWhileSteady)
#include "tst_averageWhileSteady.moc"
