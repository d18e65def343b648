#include "evaluate/sequential/SequentialTrial.h"
#include "support/studies.h"
#include "support/test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

using namespace faintline;
using test::axis;

namespace {

/// A target that stays or goes one cell to either side of a ring.
KinematicAxis ring(Index cells)
{
    return axis(cells, {0.5, 0.25}, true);
}

SequentialStudy seededStudy(const std::vector<KinematicAxis> &axes, const std::vector<bool> &isFolded,
                            std::optional<double> actualSnr = {})
{
    SequentialStudy made = test::study(axes, isFolded, 2.0, actualSnr);
    made.seed = 41;
    return made;
}

std::vector<std::vector<float>> framesOf(const SequentialStudy &made, Index trial, int stages)
{
    return test::hear(made, trial, stages).frames;
}

} // namespace

/// A trial's frames: the numbers of its own stream, with the target where it says.
class tst_SequentialTrial : public QObject
{
    Q_OBJECT

private slots:
    void framesAreOneStreamCutUp_data()
    {
        QTest::addColumn<int>("cells");
        for (const int cells : {1, 2, 3, 4, 5, 63, 64, 65, 255, 256, 257, 300})
            QTest::addRow("%d cells", cells) << cells;
    }

    // However many frames are drawn at once: no number is left out or used twice.
    void framesAreOneStreamCutUp()
    {
        QFETCH(int, cells);
        constexpr int stages = 700;
        const SequentialStudy made = seededStudy({axis(cells)}, {false});
        std::vector<float> stream(std::size_t(stages * cells));
        Random(41, 2 * 6).exponentials(stream);
        std::vector<float> frames;
        for (const std::vector<float> &frame : framesOf(made, 6, stages))
            frames.insert(frames.end(), frame.begin(), frame.end());
        QVERIFY(frames == stream);
    }

    void trialsHaveNumbersOfTheirOwn()
    {
        const SequentialStudy made = seededStudy({ring(8)}, {false}, 3.0);
        QVERIFY(framesOf(made, 4, 20) == framesOf(made, 4, 20));
        QVERIFY(framesOf(made, 4, 20) != framesOf(made, 5, 20));
        SequentialStudy other = made;
        other.seed = 42;
        QVERIFY(framesOf(made, 4, 20) != framesOf(other, 4, 20));
    }

    void theTargetRaisesItsOwnCell()
    {
        constexpr int stages = 50;
        const auto noise = framesOf(seededStudy({ring(6)}, {false}), 2, stages);
        const test::Heard heard = test::hear(seededStudy({ring(6)}, {false}, 3.0), 2, stages);
        for (std::size_t stage = 0; stage < stages; ++stage)
            for (std::size_t cell = 0; cell < 6; ++cell) {
                const float raise = Index(cell) == heard.states[stage] ? 4.0f : 1.0f; // 1 + SNR
                QCOMPARE(heard.frames[stage][cell], raise * noise[stage][cell]);
            }
    }

    void theTargetMovesAsItsModelSays()
    {
        const SequentialStudy made = seededStudy({ring(6)}, {false}, 3.0);
        constexpr int trials = 4000;
        std::array<int, 6> starts{};
        std::array<int, 6> moves{};
        for (Index number = 0; number < trials; ++number) {
            const std::vector<Index> states = test::hear(made, number, 2).states;
            ++starts[std::size_t(states[0])];
            ++moves[std::size_t((states[1] - states[0] + 6) % 6)];
        }
        const auto isNear = [](int count, double p) {
            return std::abs(count - trials * p) < 4.5 * std::sqrt(trials * p * (1.0 - p));
        };
        for (const int count : starts)
            QVERIFY2(isNear(count, 1.0 / 6.0), qPrintable(QString::number(count)));
        QVERIFY(isNear(moves[0], 0.5) && isNear(moves[1], 0.25) && isNear(moves[5], 0.25));
        QCOMPARE(moves[2] + moves[3] + moves[4], 0);
    }

    // Four cells with three folded into each: block after block of the model's cells.
    void aFoldedTargetIsAnywhereAnew()
    {
        constexpr int stages = 6000;
        const auto noise = framesOf(seededStudy({ring(4), axis(3)}, {false, true}), 0, stages);
        const test::Heard heard = test::hear(seededStudy({ring(4), axis(3)}, {false, true}, 5.0), 0, stages);
        std::array<int, 3> visits{};
        int changes = 0;
        Index before = 0;
        for (std::size_t stage = 0; stage < stages; ++stage) {
            const Index folded = heard.folded[stage];
            std::vector<float> expected = noise[stage];
            expected[std::size_t(folded * 4 + heard.states[stage])] *= 6.0f;
            QVERIFY(heard.frames[stage] == expected);
            ++visits[std::size_t(folded)];
            changes += folded != before ? 1 : 0;
            before = folded;
        }
        const double third = std::sqrt(stages * 2.0 / 9.0);
        for (const int count : visits)
            QVERIFY2(std::abs(count - stages / 3) < 4.5 * third, qPrintable(QString::number(count)));
        QVERIFY(std::abs(changes - 2 * stages / 3) < 4.5 * third); // where it was says nothing
    }

    void noiseHasNoTarget()
    {
        const test::Heard heard = test::hear(seededStudy({ring(4), axis(3)}, {false, true}), 0, 1);
        QCOMPARE(heard.frames[0].size(), std::size_t(12));
        QCOMPARE(heard.states[0], Index(-1));
        QCOMPARE(heard.folded[0], Index(0));
    }

    // λ of t = y over the mean of its N neighbours, F-distributed, written back as the y of an exponential cell.
    void averagedFramesKnowNoPower()
    {
        constexpr Index cells = 9;
        constexpr Index averaged = 4;
        SequentialStudy made = seededStudy({axis(2), ring(cells)}, {false, false}, 3.0);
        const auto plain = framesOf(made, 1, 5);
        made.averagedCells = averaged;
        const auto frames = framesOf(made, 1, 5);
        for (std::size_t stage = 0; stage < plain.size(); ++stage)
            for (Index row = 0; row < 2; ++row)
                for (Index cell = 0; cell < cells; ++cell) {
                    const float *y = plain[stage].data() + row * cells;
                    const Index begin = std::clamp<Index>(cell - averaged / 2, 0, cells - averaged - 1);
                    double sum = 0.0;
                    for (Index other = begin; other <= begin + averaged; ++other)
                        sum += other == cell ? 0.0 : double(y[other]);
                    const double n = averaged;
                    const double t = double(y[cell]) / (sum / n);
                    // The density of t is (1 + t/N)^-(N+1) on noise, that of t/(1 + SNR) with a target of the design's 2.
                    const double lambda = -std::log(3.0) + (n + 1.0) * (std::log1p(t / n) - std::log1p(t / (3.0 * n)));
                    const double found = double(frames[stage][std::size_t(row * cells + cell)]);
                    QVERIFY(std::abs(found * 2.0 / 3.0 - std::log(3.0) - lambda) < 1e-4 * (1.0 + std::abs(lambda)));
                }
    }
};

FAINTLINE_TEST(tst_SequentialTrial)
#include "tst_SequentialTrial.moc"
