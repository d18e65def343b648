#include "base/Random.h"
#include "detect/Smd.h"
#include "detect/SumDetector.h"
#include "recursion/PathTrace.h"
#include "support/paths.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

namespace {

constexpr double minus = -std::numeric_limits<double>::infinity();

struct Lattice {
    const char *name;
    std::vector<KinematicAxis> axes;
};

KinematicAxis walk(Index cells, bool cyclic, std::vector<double> q)
{
    return {"w", cells, cyclic, 0, 1, {1.0}, std::move(q), Rounding::HalfDown};
}

/// Small enough to list every path, different enough to hold every kind of axis.
std::vector<Lattice> lattices()
{
    const double third = 1.0 / 3.0;
    return {
        {"one cell, nothing moves", {rated(1, false, 0, 1, {1.0})}},
        {"stable", {rated(4, false, 0, 1, {1.0})}},
        {"three slopes, bounded", {rated(4, false, -1, 3, {third, third})}},
        {"three slopes, cyclic", {rated(5, true, -1, 3, {0.5, 0.25})}},
        {"rates of one sign", {rated(5, false, 1, 2, {0.6, 0.2})}},
        {"truncated rates", {rated(5, false, -2, 5, {0.4, 0.3}, Rounding::Trunc)}},
        {"random walk, bounded", {walk(5, false, {0.5, 0.25})}},
        {"random walk, cyclic", {walk(5, true, {0.2, 0.3, 0.1})}},
        {"range and cyclic bearing",
         {rated(3, false, -1, 3, {1.0}), rated(3, true, 0, 2, {0.5, 0.25}, Rounding::Trunc)}},
        {"rates times random walk", {rated(3, false, 0, 2, {0.5, 0.25}), walk(3, true, {0.6, 0.2})}},
        {"rates of half a cell", {fractional(5, false, 2, -2, 5, {0.8, 0.1})}},
        {"rates of a quarter, cyclic", {fractional(4, true, 4, -1, 4, {0.6, 0.2})}},
        {"thirds times halves",
         {fractional(3, false, 3, 1, 2, {0.8, 0.1}), fractional(2, false, 2, -1, 2, {0.8, 0.1})}},
        {"three axes", {walk(2, false, {0.5, 0.25}), rated(2, false, 0, 1, {1.0}), rated(2, true, -1, 2, {0.5, 0.25})}},
    };
}

/// As many frames as keep the number of paths in bounds.
Index framesFor(const StateSpace &space)
{
    Index frames = 1;
    for (double paths = 1.0; frames < 5 && paths * double(space.stateCount()) < 3e4; ++frames)
        paths *= double(space.stateCount());
    return std::max<Index>(frames, 3);
}

std::vector<std::vector<float>> randomFrames(Index cells, Index frames, std::uint64_t stream)
{
    Random random(77, stream);
    std::vector<std::vector<float>> y(std::size_t(frames), std::vector<float>(std::size_t(cells), 0.0f));
    for (auto &frame : y)
        for (float &value : frame)
            value = float(random.exponential());
    return y;
}

} // namespace

/// The one recursion against enumeration of all paths, in every semiring and with every kind of axis.
class tst_Recursion : public QObject
{
    Q_OBJECT

private slots:
    void movesSumToOne()
    {
        // Away from the edges of the rate set every state goes somewhere with probability 1.
        const KinematicAxis axis = rated(9, false, -3, 7, {0.4, 0.2, 0.1});
        double sum = 0.0;
        for (const KinematicAxis::Move &move : axis.moves())
            if (move.fromRate == 3)
                sum += std::exp(move.lnProbability);
        QVERIFY(std::abs(sum - 1.0) < 1e-12);
    }

    void fractionalRatesKeepToTheirLine()
    {
        // Who keeps a rate of k/8 cell a step is never more than half a cell from the straight line, and makes k cells in 8
        // steps.
        const KinematicAxis axis = fractional(9, false, 8, -8, 17, {0.9, 0.05});
        for (int rate = 0; rate < 17; ++rate) {
            double at = 0.0;
            for (Index step = 0; step < 40; ++step) {
                for (const KinematicAxis::Move &move : axis.moves(step))
                    if (move.fromRate == rate && move.toRate == rate)
                        at += move.cells;
                QVERIFY(std::abs(at - axis.rate(rate) * double(step + 1)) <= 0.5);
            }
            QCOMPARE(at, double(5 * (rate - 8)));
        }
        QCOMPARE(axis.largestDisplacement(), 1);
        QCOMPARE(StateSpace({fractional(9, false, 8, 0, 2, {1.0}), fractional(9, false, 6, 0, 2, {1.0})}).phaseCount(),
                 Index(24));
    }

    void predecessorsAreTheDefinition_data() { rows(); }

    void predecessorsAreTheDefinition()
    {
        const MarkovModel m = model();
        for (Index step = 0; step < m.space.phaseCount() + 1; ++step)
            for (Index to = 0; to < m.space.stateCount(); ++to) {
                std::vector<double> expected(std::size_t(m.space.stateCount()), 0.0);
                for (const StateSpace::Predecessor &p : m.space.predecessors(to, step))
                    expected[std::size_t(p.state)] =
                        std::max(expected[std::size_t(p.state)], std::exp(p.lnProbability));
                for (Index from = 0; from < m.space.stateCount(); ++from)
                    QVERIFY(std::abs(expected[std::size_t(from)] - transitionProbability(m.space, from, to, step))
                            < 1e-12);
            }
    }

    void bestPathWithReset_data() { rows(); }

    void bestPathWithReset()
    {
        const MarkovModel m = model();
        const Index states = m.space.stateCount();
        const Index frames = framesFor(m.space);
        const double lnK = 0.35;
        const auto y = randomFrames(m.space.cellCount(), frames, 1);
        Smd detector(m, {ResetLaw::Fixed, lnK});
        std::vector<float> statistic(std::size_t(m.space.cellCount()));
        for (const auto &frame : y)
            detector.update(frame, statistic);

        // ln(N Λ): the best over all paths and all starting times of Σ λ + Σ (ln P + ln K).
        for (Index last = 0; last < states; ++last) {
            double best = minus;
            for (Index length = 1; length <= frames; ++length) {
                forEachPath(states, length, last, [&](const std::vector<Index> &path) {
                    double score = 0.0;
                    for (std::size_t i = 0; i < path.size(); ++i) {
                        const auto t = std::size_t(frames - length) + i;
                        score += m.likelihood.at(double(y[t][std::size_t(m.space.cellOf(path[i]))]));
                        if (i > 0)
                            score += lnK + std::log(transitionProbability(m.space, path[i - 1], path[i], Index(t)));
                    }
                    best = std::max(best, score);
                });
            }
            const auto found = double(detector.scores()[std::size_t(last)]);
            QVERIFY2(std::abs(found - best) < 2e-5,
                     qPrintable(QString("state %1: %2, enumeration %3").arg(last).arg(found).arg(best)));
        }
        for (Index cell = 0; cell < m.space.cellCount(); ++cell) {
            float best = -1e30f;
            for (Index plane = 0; plane < m.space.planeCount(); ++plane)
                best = std::max(best, detector.scores()[std::size_t(plane * m.space.cellCount() + cell)]);
            QCOMPARE(statistic[std::size_t(cell)], best);
        }
    }

    void bestPathWithoutReset_data() { rows(); }

    void bestPathWithoutReset()
    {
        const MarkovModel m = model();
        const Index states = m.space.stateCount();
        const Index frames = framesFor(m.space);
        const auto y = randomFrames(m.space.cellCount(), frames, 2);
        Smd detector(m, {ResetLaw::None});
        std::vector<float> statistic(std::size_t(m.space.cellCount()));
        for (const auto &frame : y)
            detector.update(frame, statistic);
        for (Index last = 0; last < states; ++last) {
            double best = minus;
            forEachPath(states, frames, last, [&](const std::vector<Index> &path) {
                double score = 0.0;
                for (std::size_t i = 0; i < path.size(); ++i) {
                    score += m.likelihood.at(double(y[i][std::size_t(m.space.cellOf(path[i]))]));
                    if (i > 0)
                        score += std::log(transitionProbability(m.space, path[i - 1], path[i], Index(i)));
                }
                best = std::max(best, score);
            });
            const auto found = double(detector.scores()[std::size_t(last)]);
            if (best == minus)
                QCOMPARE(found, minus); // no state leads here
            else
                QVERIFY(std::abs(found - best) < 2e-5);
        }
    }

    void sumOverPaths_data() { rows(); }

    void sumOverPaths()
    {
        const MarkovModel m = model();
        const Index states = m.space.stateCount();
        const Index frames = framesFor(m.space);
        const auto y = randomFrames(m.space.cellCount(), frames, 3);
        SumDetector detector(m, {ResetLaw::None});
        std::vector<float> statistic(std::size_t(m.space.cellCount()));
        for (const auto &frame : y)
            detector.update(frame, statistic);
        double total = 0.0; // in the linear domain, uniform initial law
        for (Index last = 0; last < states; ++last)
            forEachPath(states, frames, last, [&](const std::vector<Index> &path) {
                double product = 1.0 / double(states);
                for (std::size_t i = 0; i < path.size(); ++i) {
                    product *= std::exp(m.likelihood.at(double(y[i][std::size_t(m.space.cellOf(path[i]))])));
                    if (i > 0)
                        product *= transitionProbability(m.space, path[i - 1], path[i], Index(i));
                }
                total += product;
            });
        QVERIFY2(
            std::abs(detector.lnMean() - std::log(total)) < 1e-9 * std::max(1.0, std::abs(std::log(total))),
            qPrintable(
                QString("%1, enumeration %2").arg(detector.lnMean(), 0, 'g', 15).arg(std::log(total), 0, 'g', 15)));
    }

    void sumWithReset()
    {
        // Shiryaev-Roberts on one state: A(t) = e^λ (K A(t-1) + 1), by hand.
        const MarkovModel m{StateSpace({rated(1, false, 0, 1, {1.0})}), Likelihood(LikelihoodKind::Linear), 1.0};
        SumDetector detector(m, {ResetLaw::Fixed, std::log(0.5)});
        std::vector<float> statistic(1);
        double expected = 0.0;
        for (float y : {0.5f, 1.25f, 0.0f, 2.0f}) {
            detector.update(std::vector<float>{y}, statistic);
            expected = std::exp(double(y)) * (expected == 0.0 ? 1.0 : 0.5 * expected + 1.0);
            QVERIFY(std::abs(double(statistic[0]) - std::log(expected)) < 1e-6);
        }
    }

    void tracedTermsAddUp_data() { rows(); }

    void tracedTermsAddUp()
    {
        const MarkovModel m = model();
        Grid grid;
        for (const KinematicAxis &axis : m.space.axes())
            grid.axes.push_back({axis.name, "", 0.0, 1.0, axis.cells, axis.cyclic});
        const Index frames = 40;
        const double lnK = 0.2;
        const auto y = randomFrames(m.space.cellCount(), frames, 4);
        Smd detector(m, {ResetLaw::Fixed, lnK});
        std::vector<float> statistic(std::size_t(m.space.cellCount()));
        std::vector<std::vector<float>> scores;
        for (const auto &frame : y) {
            detector.update(frame, statistic);
            scores.emplace_back(detector.scores().begin(), detector.scores().end());
        }
        RecursionRecord record;
        record.frame = [&](Index t) { return std::span<const float>(y[std::size_t(t)]); };
        record.lnK = [&](Index) { return lnK; };
        record.forgotten = [](Index) { return std::span<const CellBox>(); };
        for (Index state = 0; state < m.space.stateCount(); ++state) {
            const std::vector<PathStep> path =
                tracePath(m, grid, record, {frames - 1, state, double(detector.scores()[std::size_t(state)])});
            QCOMPARE(path.back().state, state);
            QCOMPARE(path.back().frame, frames - 1);
            double sum = 0.0;
            for (std::size_t i = 0; i < path.size(); ++i) {
                if (i > 0) {
                    QCOMPARE(path[i].frame, path[i - 1].frame + 1);
                    QVERIFY(std::abs(std::exp(path[i].lnTransition)
                                     - transitionProbability(m.space, path[i - 1].state, path[i].state, path[i].frame))
                            < 1e-12);
                    QVERIFY(path[i - 1].score + path[i].lnTransition + path[i].lnK
                            > 0.0); // else it would have been reset
                }
                sum += path[i].logLikelihoodRatio + path[i].lnTransition + path[i].lnK;
            }
            QVERIFY(std::abs(sum - double(detector.scores()[std::size_t(state)])) < 1e-4);

            // With checkpoints in every fifth frame, the newest forgotten: the same path.
            RecursionRecord cut = record;
            cut.checkpoint = [&](Index before) {
                const Index at = std::min<Index>((before - 1) / 5 * 5, 30);
                return before > at ? RecursionRecord::Checkpoint{at, scores[std::size_t(at)]}
                                   : RecursionRecord::Checkpoint{};
            };
            const std::vector<PathStep> again =
                tracePath(m, grid, cut, {frames - 1, state, double(detector.scores()[std::size_t(state)])});
            QCOMPARE(again.size(), path.size());
            for (std::size_t i = 0; i < path.size(); ++i)
                QCOMPARE(again[i].state, path[i].state);
        }
    }

    void aThousandFramesStayFinite()
    {
        const MarkovModel m{StateSpace({rated(6, true, -1, 3, {0.5, 0.25})}),
                            Likelihood(LikelihoodKind::Exponential, 4.0), 1.0};
        SumDetector sum(m, {ResetLaw::None});
        Smd best(m, {ResetLaw::None});
        std::vector<float> statistic(6);
        for (const auto &frame : randomFrames(6, 1000, 5)) {
            sum.update(frame, statistic);
            best.update(frame, statistic);
        }
        QVERIFY(std::isfinite(sum.lnMean()));
        // The sum holds the best path and less than all of them at the best's score.
        const double score = double(*std::max_element(statistic.begin(), statistic.end()));
        QVERIFY(sum.lnMean() > score - std::log(18.0) - 1e-3);
    }

    void shiftByACellShiftsTheAnswer()
    {
        const MarkovModel m{StateSpace({rated(32, true, -2, 5, {1.0 / 3.0, 1.0 / 3.0})}),
                            Likelihood(LikelihoodKind::Rice, 0.5), 1.0};
        Smd straight(m, {ResetLaw::Fixed, 0.69});
        Smd shifted(m, {ResetLaw::Fixed, 0.69});
        std::vector<float> a(32);
        std::vector<float> b(32);
        for (auto frame : randomFrames(32, 50, 6)) {
            straight.update(frame, a);
            std::rotate(frame.begin(), frame.end() - 5, frame.end());
            shifted.update(frame, b);
        }
        std::rotate(b.begin(), b.begin() + 5, b.end());
        QCOMPARE(a, b);
    }

    void tilesAreTheDefinition_data()
    {
        // Grids of several tiles, with their edges, wraps and blocks: state by state against the list of predecessors.
        QTest::addColumn<int>("index");
        QTest::newRow("range and cyclic bearing") << 0;
        QTest::newRow("both cyclic") << 1;
        QTest::newRow("random walk in bearing") << 2;
        QTest::newRow("rates that nothing leads to") << 3;
        QTest::newRow("one long axis") << 4;
        QTest::newRow("three axes") << 5;
        QTest::newRow("eighths of a cell") << 6;
        QTest::newRow("halves, and thirds along a cyclic axis") << 7;
    }

    void tilesAreTheDefinition()
    {
        const double ninth = 1.0 / 9.0;
        const std::vector<std::vector<KinematicAxis>> spaces{
            {rated(700, false, -3, 7, {ninth, ninth, ninth, ninth, ninth}, Rounding::Trunc),
             rated(20, true, -1, 3, {0.5, 0.25}, Rounding::Trunc)},
            {rated(500, true, -2, 5, {0.4, 0.3}), rated(12, true, -2, 5, {0.6, 0.2})},
            {rated(900, false, 1, 3, {1.0}), walk(10, false, {0.5, 0.25})},
            {rated(300, false, -1, 3, {0.0, 0.5}), rated(16, true, 2, 1, {1.0})},
            {rated(9000, false, -2, 5, {1.0 / 3.0, 1.0 / 3.0})},
            {walk(40, false, {0.5, 0.25}), rated(30, false, -2, 4, {0.5, 0.25}), rated(8, true, -1, 2, {0.5, 0.25})},
            {fractional(9000, false, 8, -8, 17, {0.9, 0.05})},
            {fractional(300, false, 2, -8, 17, {0.8, 0.1}), fractional(12, true, 3, -2, 5, {0.6, 0.2})}};
        QFETCH(int, index);
        const StateSpace space(spaces[std::size_t(index)]);
        Random random(78, 0);
        std::vector<float> scores(std::size_t(space.stateCount()));
        for (float &score : scores)
            score = float(10.0 * random.exponential());
        Recursion<MaxPlus<float>> recursion(space);
        for (Index step = 0; step < space.phaseCount(); ++step) {
            const std::span<const float> predicted = recursion.predict(scores, step);
            std::vector<int> visits(scores.size(), 0);
            Recursion<MaxPlus<float>> tiled(space);
            tiled.predict(scores, step, [&](Index plane, Index firstCell, std::span<const float> part) {
                for (std::size_t i = 0; i < part.size(); ++i) {
                    const std::size_t n = std::size_t(plane * space.cellCount() + firstCell) + i;
                    ++visits[n];
                    QCOMPARE(part[i], predicted[n]);
                }
            });
            for (Index state = 0; state < space.stateCount(); state += state % 97 == 0 ? 1 : 61) {
                double best = minus;
                for (const StateSpace::Predecessor &p : space.predecessors(state, step))
                    best = std::max(best, double(scores[std::size_t(p.state)]) + p.lnProbability);
                const auto found = double(predicted[std::size_t(state)]);
                QVERIFY2(best == minus ? found == minus : std::abs(found - best) < 2e-5,
                         qPrintable(QString("state %1").arg(state)));
            }
            QVERIFY(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
        }
    }

private:
    void rows()
    {
        QTest::addColumn<int>("index");
        for (std::size_t i = 0; i < lattices().size(); ++i)
            QTest::newRow(lattices()[i].name) << int(i);
    }
    MarkovModel model() const
    {
        QFETCH(int, index);
        return {StateSpace(lattices()[std::size_t(index)].axes), Likelihood(LikelihoodKind::Rice, 0.8), 1.0};
    }
};

FAINTLINE_TEST(tst_Recursion)
#include "tst_Recursion.moc"
