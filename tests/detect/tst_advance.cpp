#include "app/cli/speed/plainForms.h"
#include "base/Random.h"
#include "detect/Smd.h"
#include "support/paths.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

namespace {

struct Case {
    const char *name;
    std::vector<KinematicAxis> axes;
};

std::vector<Case> cases()
{
    const double third = 1.0 / 3.0;
    const double ninth = 1.0 / 9.0;
    const std::vector<double> wide(5, ninth);
    return {
        {"one slope, many cells", {rated(3000, false, 0, 1, {1.0})}},
        {"five slopes, several tiles", {rated(5003, false, -2, 5, {third, third})}},
        {"21 slopes", {rated(2500, false, -10, 21, {third, third})}},
        {"more slopes than a tile's margin is wide", {rated(1200, false, -40, 81, {third, third})}},
        {"fewer cells than slopes reach", {rated(7, false, -10, 21, {third, third})}},
        {"rates of one sign", {rated(2100, false, 3, 4, {0.5, 0.25})}},
        {"unequal weights", {rated(2100, false, -3, 7, {0.6, 0.2})}},
        {"cyclic", {rated(2100, true, -3, 7, {third, third})}},
        {"shared maxima, half down", {rated(2100, false, -9, 19, wide)}},
        {"shared maxima, truncated, cyclic", {rated(2100, true, -9, 19, wide, Rounding::Trunc)}},
        {"shared maxima over three", {rated(900, false, -4, 9, {0.2, 0.2, 0.2})}},
        {"range and cyclic bearing",
         {rated(300, false, -9, 19, wide, Rounding::Trunc), rated(20, true, -1, 3, {0.5, 0.25}, Rounding::Trunc)}},
        {"eighths of a cell, several tiles", {fractional(5003, false, 8, -8, 17, {0.9, 0.05})}},
        {"halves of a cell", {fractional(2500, false, 2, -8, 17, {0.8, 0.1})}},
        {"eighths of a cell, cyclic", {fractional(2100, true, 8, -8, 17, {0.9, 0.05})}},
        {"one rate of a third", {fractional(2100, false, 3, 1, 1, {1.0})}},
        {"halves, and thirds along a cyclic axis",
         {fractional(300, false, 2, -4, 9, {0.8, 0.1}), fractional(20, true, 3, -1, 3, {0.5, 0.25})}},
        {"both bounded, one-to-one", {rated(200, false, -5, 11, {1.0}), rated(13, false, -2, 5, {1.0})}},
    };
}

std::vector<float> noise(Index count)
{
    std::vector<float> y(static_cast<std::size_t>(count));
    Random(5, 0).exponentials(y);
    return y;
}

} // namespace

/// Many frames at once, many threads, the fused kernels: against the formula and against one frame at a time.
class tst_advance : public QObject
{
    Q_OBJECT

private slots:
    void isTheFormula_data() { rows(); }

    void isTheFormula()
    {
        const MarkovModel m = model();
        const Index cells = m.space.cellCount();
        const double lnK = -0.9;
        const Index frames = 20;
        const std::vector<float> y = noise(frames * cells);
        std::vector<float> found(y.size());
        std::vector<float> expected(static_cast<std::size_t>(cells));
        Smd detector(m, {ResetLaw::Fixed, lnK});
        detector.updateBlock(y, found, cells);
        FormulaRecursion formula(m.space, lnK);
        for (Index frame = 0; frame < frames; ++frame) {
            formula.update(std::span(y).subspan(std::size_t(frame * cells), expected.size()), expected);
            for (std::size_t cell = 0; cell < expected.size(); ++cell)
                QVERIFY2(std::abs(found[std::size_t(frame * cells) + cell] - expected[cell]) < 2e-5f * float(frame + 1),
                         qPrintable(QString("frame %1 cell %2").arg(frame).arg(cell)));
        }
        for (std::size_t state = 0; state < formula.scores().size(); ++state)
            QVERIFY(std::abs(double(detector.scores()[state]) - formula.scores()[state]) < 4e-4);
    }

    void blocksAndThreadsChangeNoBit_data() { rows(); }

    void blocksAndThreadsChangeNoBit()
    {
        const MarkovModel m = model();
        const Index cells = m.space.cellCount();
        const Index frames = 41;
        const std::vector<float> y = noise(frames * cells);
        const auto run = [&](Index block, int threads, std::vector<float> &statistic, Smd &detector) {
            detector.useThreads(threads);
            statistic.resize(y.size());
            for (Index done = 0; done < frames; done += block) {
                const auto first = std::size_t(done * cells);
                const auto count = std::size_t(std::min(block, frames - done) * cells);
                detector.updateBlock(std::span(y).subspan(first, count), std::span(statistic).subspan(first, count),
                                     cells);
            }
        };
        std::vector<float> expected;
        Smd reference(m, {ResetLaw::Fixed, -0.9});
        run(1, 1, expected, reference);
        const std::vector<std::pair<Index, int>> ways{{2, 1},  {3, 2},  {7, 1},  {16, 1},
                                                      {41, 1}, {41, 2}, {41, 3}, {1, 3}};
        for (const auto &[block, threads] : ways) {
            std::vector<float> found;
            Smd detector(m, {ResetLaw::Fixed, -0.9});
            run(block, threads, found, detector);
            QVERIFY2(found == expected, qPrintable(QString("blocks of %1, %2 threads").arg(block).arg(threads)));
            QVERIFY(std::equal(detector.scores().begin(), detector.scores().end(), reference.scores().begin()));
            QCOMPARE(detector.regulation().continuedFraction, reference.regulation().continuedFraction);
        }
    }

    void regulationDoesNotDependOnThreads()
    {
        // Parsons' law sums over all states in floating point: large enough for several threads to take part.
        const MarkovModel m{
            StateSpace({rated(4000, false, -10, 21, std::vector<double>(5, 1.0 / 9.0)), rated(8, true, 0, 1, {1.0})}),
            Likelihood(LikelihoodKind::Linear), 1.0};
        const Index cells = m.space.cellCount();
        const std::vector<float> y = noise(4 * cells);
        std::vector<float> a(y.size());
        std::vector<float> b(y.size());
        Smd one(m, {ResetLaw::Mean});
        Smd three(m, {ResetLaw::Mean});
        three.useThreads(3);
        one.updateBlock(y, a, cells);
        three.updateBlock(y, b, cells);
        QVERIFY(a == b);
        QCOMPARE(three.regulation().lnK, one.regulation().lnK);
        QVERIFY(one.regulation().lnK < 0.0);
    }

    void withoutReset()
    {
        // The best of all paths from the first frame: on one slope simply the sum.
        const MarkovModel m{StateSpace({rated(100, false, 0, 1, {1.0})}), Likelihood(LikelihoodKind::Linear), 1.0};
        const std::vector<float> y = noise(9 * 100);
        std::vector<float> found(y.size());
        Smd detector(m, {ResetLaw::None});
        detector.updateBlock(y, found, 100);
        for (std::size_t cell = 0; cell < 100; ++cell) {
            double sum = 0.0;
            for (std::size_t frame = 0; frame < 9; ++frame)
                sum += double(y[frame * 100 + cell]);
            QVERIFY(std::abs(double(found[800 + cell]) - sum) < 1e-5);
        }
        QCOMPARE(detector.regulation().continuedFraction, 1.0);
    }

    void EigenIsTheFormula_data() { rows(); }

    void EigenIsTheFormula()
    {
        // What the fast form is timed against does the same work.
        const MarkovModel m = model();
        const auto cells = std::size_t(m.space.cellCount());
        const std::vector<float> y = noise(6 * m.space.cellCount());
        FormulaRecursion formula(m.space, -0.9);
        EigenRecursion eigen(m.space, -0.9f);
        std::vector<float> expected(cells);
        std::vector<float> found(cells);
        for (std::size_t frame = 0; frame < 6; ++frame) {
            formula.update(std::span(y).subspan(frame * cells, cells), expected);
            eigen.update(std::span(y).subspan(frame * cells, cells), found);
        }
        for (std::size_t cell = 0; cell < cells; ++cell)
            QVERIFY(std::abs(found[cell] - expected[cell]) < 1e-4f);
    }

private:
    void rows()
    {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < cases().size(); ++i)
            QTest::newRow(cases()[i].name) << int(i);
    }
    MarkovModel model() const
    {
        QFETCH(int, index);
        return {StateSpace(cases()[std::size_t(index)].axes), Likelihood(LikelihoodKind::Linear), 1.0};
    }
};

FAINTLINE_TEST(tst_advance)
#include "tst_advance.moc"
