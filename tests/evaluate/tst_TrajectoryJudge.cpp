#include "evaluate/sequential/SequentialTrial.h"
#include "support/test.h"

#include "support/studies.h"

#include <algorithm>
#include <cmath>

using namespace faintline;
using test::axis;
using test::hear;
using test::Heard;

namespace {

constexpr double snr = 2.0;

SequentialStudy judgedStudy(const std::vector<KinematicAxis> &axes, const std::vector<bool> &isFolded, double actualSnr)
{
    SequentialStudy made = test::study(axes, isFolded, snr, actualSnr);
    made.seed = 23;
    return made;
}

/// P(to | from) on one axis: the steps that exist share what the others would have.
double moveProbability(const KinematicAxis &axis, Index from, Index to)
{
    const auto weight = [&](Index other) {
        Index d = std::abs(other - from);
        if (axis.cyclic)
            d = std::min(d, axis.cells - d);
        return d < std::ssize(axis.step) ? axis.step[std::size_t(d)] : 0.0;
    };
    double sum = 0.0;
    for (Index other = 0; other < axis.cells; ++other)
        sum += weight(other);
    return weight(to) / sum;
}

double lambda(double y)
{
    return y * snr / (1.0 + snr) - std::log(1.0 + snr);
}

/// The best of all cells^stages trajectories, tried one after the other. `evidence(stage, cell)`, `law(from, to)`.
template <class Evidence, class Law>
std::vector<Index> bestOfAll(Index cells, Index stages, Evidence evidence, Law law)
{
    std::vector<Index> path(std::size_t(stages), 0);
    std::vector<Index> best;
    double highest = -INFINITY;
    for (;;) {
        double score = -std::log(double(cells));
        for (std::size_t k = 0; k < path.size(); ++k)
            score += evidence(Index(k), path[k]) + (k > 0 ? std::log(law(path[k - 1], path[k])) : 0.0);
        if (score > highest) {
            highest = score;
            best = path;
        }
        std::size_t digit = 0;
        while (digit < path.size() && ++path[digit] == cells)
            path[digit++] = 0;
        if (digit == path.size())
            return best;
    }
}

} // namespace

/// The errors of a trajectory's estimate, against the best of all trajectories found by trying each.
class tst_TrajectoryJudge : public QObject
{
    Q_OBJECT

private slots:
    void onALine_data()
    {
        QTest::addColumn<bool>("isCyclic");
        QTest::addColumn<int>("stages");
        QTest::newRow("one stage") << false << 1;
        QTest::newRow("between ends") << false << 5;
        QTest::newRow("round a ring") << true << 5;
    }

    void onALine()
    {
        QFETCH(bool, isCyclic);
        QFETCH(int, stages);
        constexpr Index cells = 6;
        const KinematicAxis line = axis(cells, {0.5, 0.25}, isCyclic);
        const SequentialStudy made = judgedStudy({line}, {false}, snr);
        const TrajectorySampler sampler(made.model);
        TrajectoryJudge judge(made, sampler);
        Index largestOfAll = 0;
        for (Index number = 0; number < 12; ++number) {
            const Heard heard = hear(made, number, stages);
            const std::vector<Index> best = bestOfAll(
                cells, stages,
                [&](Index k, Index cell) { return lambda(double(heard.frames[std::size_t(k)][std::size_t(cell)])); },
                [&](Index from, Index to) { return moveProbability(line, from, to); });
            Index last = 0;
            Index largest = 0;
            for (std::size_t k = 0; k < best.size(); ++k) {
                last = std::abs(best[k] - heard.states[k]);
                if (isCyclic)
                    last = std::min(last, cells - last);
                largest = std::max(largest, last);
            }
            const TrajectoryJudge::Errors errors = judge.errorsOf(number, stages);
            QCOMPARE(errors.last, last);
            QCOMPARE(errors.largest, largest);
            largestOfAll = std::max(largestOfAll, largest);
        }
        QVERIFY(largestOfAll > 0); // weak enough to go wrong
    }

    void onTwoAxesTheLargerErrorCounts()
    {
        const KinematicAxis rows = axis(2, {0.6, 0.2});
        const KinematicAxis columns = axis(4, {0.5, 0.25});
        const SequentialStudy made = judgedStudy({rows, columns}, {false, false}, snr);
        const TrajectorySampler sampler(made.model);
        TrajectoryJudge judge(made, sampler);
        int differ = 0;
        for (Index number = 0; number < 12; ++number) {
            const Heard heard = hear(made, number, 4);
            const std::vector<Index> best = bestOfAll(
                8, 4,
                [&](Index k, Index cell) { return lambda(double(heard.frames[std::size_t(k)][std::size_t(cell)])); },
                [&](Index from, Index to) {
                    return moveProbability(rows, from / 4, to / 4) * moveProbability(columns, from % 4, to % 4);
                });
            Index last = 0;
            Index largest = 0;
            for (std::size_t k = 0; k < best.size(); ++k) {
                const Index down = std::abs(best[k] / 4 - heard.states[k] / 4);
                const Index along = std::abs(best[k] % 4 - heard.states[k] % 4);
                differ += down != along ? 1 : 0;
                last = std::max(down, along);
                largest = std::max(largest, last);
            }
            const TrajectoryJudge::Errors errors = judge.errorsOf(number, 4);
            QCOMPARE(errors.last, last);
            QCOMPARE(errors.largest, largest);
        }
        QVERIFY(differ > 0);
    }

    void theBestOfFoldedCellsStandsForThem()
    {
        const KinematicAxis line = axis(5, {0.5, 0.25});
        const SequentialStudy made = judgedStudy({line, axis(3)}, {false, true}, snr);
        const TrajectorySampler sampler(made.model);
        TrajectoryJudge judge(made, sampler);
        for (Index number = 0; number < 12; ++number) {
            const Heard heard = hear(made, number, 4);
            const std::vector<Index> best = bestOfAll(
                5, 4,
                [&](Index k, Index cell) {
                    const std::vector<float> &y = heard.frames[std::size_t(k)];
                    return lambda(
                        double(std::max({y[std::size_t(cell)], y[std::size_t(5 + cell)], y[std::size_t(10 + cell)]})));
                },
                [&](Index from, Index to) { return moveProbability(line, from, to); });
            Index largest = 0;
            for (std::size_t k = 0; k < best.size(); ++k)
                largest = std::max(largest, std::abs(best[k] - heard.states[k]));
            QCOMPARE(judge.errorsOf(number, 4).last, std::abs(best.back() - heard.states.back()));
            QCOMPARE(judge.errorsOf(number, 4).largest, largest);
        }
    }

    void whereAllIsFoldedTheFoldedCellIsThePosition()
    {
        const SequentialStudy made = judgedStudy({axis(7)}, {true}, 5.0);
        const TrajectorySampler sampler(made.model);
        TrajectoryJudge judge(made, sampler);
        for (Index number = 0; number < 20; ++number) {
            const Heard heard = hear(made, number, 6);
            Index last = 0;
            Index largest = 0;
            for (std::size_t k = 0; k < heard.frames.size(); ++k) {
                const std::vector<float> &y = heard.frames[k];
                last = std::abs(Index(std::max_element(y.begin(), y.end()) - y.begin()) - heard.folded[k]);
                largest = std::max(largest, last);
            }
            const TrajectoryJudge::Errors errors = judge.errorsOf(number, 6);
            QCOMPARE(errors.last, last);
            QCOMPARE(errors.largest, largest);
        }
    }

    void whatIsLoudIsFollowedExactly()
    {
        const SequentialStudy made = judgedStudy({axis(50, {0.5, 0.25})}, {false}, 1e6);
        const TrajectorySampler sampler(made.model);
        TrajectoryJudge judge(made, sampler);
        for (Index number = 0; number < 20; ++number)
            QCOMPARE(judge.errorsOf(number, 30).largest, Index(0));
    }
};

FAINTLINE_TEST(tst_TrajectoryJudge)
#include "tst_TrajectoryJudge.moc"
