#include "base/Random.h"
#include "recursion/presence.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

/// Three slopes of half a bin with inertia, whose moves repeat after two frames.
KinematicAxis halfBins(Index cells)
{
    return {.name = "f", .cells = cells, .firstRate = -1, .rateCount = 3, .rateChange = {0.8, 0.1}, .ratesPerCell = 2};
}

Corridor smallCorridor(std::uint64_t seed)
{
    Random random(seed, 0);
    Corridor corridor;
    corridor.width = 3;
    corridor.firstCells = {4, 5, 5, 4};
    for (std::size_t i = 0; i < 12; ++i)
        corridor.lambda.push_back(float(4.0 * random.uniform() - 1.5));
    return corridor;
}

/// A state of one frame: rate and cell of the corridor, or rate -1: off.
struct State {
    int rate = -1;
    Index cell = 0;
};

double transition(const KinematicAxis &axis, const Corridor &corridor, Index frame, const State &from, const State &to,
                  double change, Index firstStep)
{
    const double states = double(axis.rateCount) * double(corridor.width);
    if (from.rate < 0)
        return to.rate < 0 ? 1.0 - change : change / states;
    if (to.rate < 0)
        return change;
    const Index moved =
        corridor.firstCells[std::size_t(frame)] + to.cell - corridor.firstCells[std::size_t(frame - 1)] - from.cell;
    double p = 0.0;
    for (const KinematicAxis::Move &move : axis.moves(firstStep + frame))
        if (move.fromRate == from.rate && move.toRate == to.rate && move.cells == moved)
            p += std::exp(move.lnProbability);
    return p;
}

/// Every sequence of states, with its weight, given to take(sequence, weight).
template <class Take>
void enumerate(const KinematicAxis &axis, const Corridor &corridor, double change, Index firstStep, Take take,
               CorridorEnds ends = {})
{
    const double onAtFirst = ends.absentBefore ? change : 0.5;
    std::vector<State> states{{-1, 0}};
    for (int rate = 0; rate < axis.rateCount; ++rate)
        for (Index cell = 0; cell < corridor.width; ++cell)
            states.push_back({rate, cell});
    std::vector<State> sequence;
    const auto descend = [&](auto &&self, double weight) -> void {
        const Index frame = std::ssize(sequence);
        if (!sequence.empty() && frame == corridor.frameCount()) {
            const double onAtLast = ends.absentAfter ? change : 0.5;
            take(sequence, weight * (sequence.back().rate < 0 ? 1.0 - onAtLast : onAtLast));
            return;
        }
        for (const State &state : states) {
            double w = weight;
            if (frame == 0)
                w *= state.rate < 0 ? 1.0 - onAtFirst : onAtFirst / double(states.size() - 1);
            else
                w *= transition(axis, corridor, frame, sequence.back(), state, change, firstStep);
            if (state.rate >= 0)
                w *= std::exp(double(corridor.lambda[std::size_t(frame * corridor.width + state.cell)]));
            if (w == 0.0)
                continue;
            sequence.push_back(state);
            self(self, w);
            sequence.pop_back();
        }
    };
    descend(descend, 1.0);
}

} // namespace

/// The posterior of presence and place, and the strongest path, against all sequences of states and a line of known
/// place.
class tst_presence : public QObject
{
    Q_OBJECT

private slots:
    void isTheSumOverAllSequences_data()
    {
        QTest::addColumn<int>("firstStep");
        QTest::addColumn<CorridorEnds>("ends");
        QTest::newRow("even") << 0 << CorridorEnds();
        QTest::newRow("odd") << 7 << CorridorEnds();
        QTest::newRow("absent before") << 0 << CorridorEnds{true, false};
        QTest::newRow("absent before and after") << 7 << CorridorEnds{true, true};
    }

    void isTheSumOverAllSequences()
    {
        QFETCH(int, firstStep);
        QFETCH(CorridorEnds, ends);
        const KinematicAxis axis = halfBins(12);
        const Corridor corridor = smallCorridor(3);
        const double lnChange = std::log(0.07);
        const Presence found = presenceIn(corridor, axis, lnChange, firstStep, ends);
        for (Index frame = 0; frame < corridor.frameCount(); ++frame) {
            std::vector<double> cells(std::size_t(corridor.width));
            double off = 0.0;
            enumerate(
                axis, corridor, std::exp(lnChange), firstStep,
                [&](const std::vector<State> &sequence, double weight) {
                    const State &state = sequence[std::size_t(frame)];
                    (state.rate < 0 ? off : cells[std::size_t(state.cell)]) += weight;
                },
                ends);
            const double on = cells[0] + cells[1] + cells[2];
            const auto at = std::size_t(frame);
            const auto first = double(corridor.firstCells[at]);
            QVERIFY(std::abs(double(found.present[at]) - on / (on + off)) < 1e-6); // stored as float
            QVERIFY(std::abs(found.mean[at] - (first + (cells[1] + 2.0 * cells[2]) / on)) < 1e-9);
            // 5 % of the whole, linear inside a cell: in the first one here, or not at all.
            if (cells[0] > 0.05 * on)
                QVERIFY(std::abs(double(found.low[at]) - (first - 0.5 + 0.05 * on / cells[0])) < 1e-5);
            if (cells[2] > 0.05 * on)
                QVERIFY(std::abs(double(found.high[at]) - (first + 2.5 - 0.05 * on / cells[2])) < 1e-5);
        }
    }

    void slopeChangesAreTheSumOverAllSequences_data()
    {
        QTest::addColumn<int>("firstStep");
        QTest::newRow("even") << 0;
        QTest::newRow("odd") << 7;
    }

    void slopeChangesAreTheSumOverAllSequences()
    {
        QFETCH(int, firstStep);
        const KinematicAxis axis = halfBins(12);
        const Corridor corridor = smallCorridor(5);
        const double lnChange = std::log(0.07);
        std::vector<double> expected(2);
        double all = 0.0;
        enumerate(
            axis, corridor, std::exp(lnChange), firstStep, [&](const std::vector<State> &sequence, double weight) {
                all += weight;
                for (std::size_t frame = 1; frame < sequence.size(); ++frame)
                    if (sequence[frame - 1].rate >= 0 && sequence[frame].rate >= 0)
                        expected[std::size_t(std::abs(sequence[frame].rate - sequence[frame - 1].rate))] += weight;
            });
        const std::vector<double> found = expectedSlopeChanges(corridor, axis, lnChange, firstStep);
        QCOMPARE(found.size(), expected.size());
        for (std::size_t i = 0; i < found.size(); ++i)
            QVERIFY(std::abs(found[i] - expected[i] / all) < 1e-9);
    }

    void strongestPathIsTheBestOfAll()
    {
        const KinematicAxis axis = halfBins(12);
        for (std::uint64_t seed = 1; seed < 20; ++seed) {
            const Corridor corridor = smallCorridor(seed);
            const std::vector<double> lnK{0.1, -0.2, 0.3, -0.4};
            // All paths that begin anywhere, end anywhere and are never off in between.
            double best = -std::numeric_limits<double>::infinity();
            const auto descend = [&](auto &&self, Index frame, const State &state, double score) -> void {
                best = std::max(best, score);
                if (frame + 1 == corridor.frameCount())
                    return;
                for (int rate = 0; rate < axis.rateCount; ++rate)
                    for (Index cell = 0; cell < corridor.width; ++cell) {
                        const State next{rate, cell};
                        if (const double p = transition(axis, corridor, frame + 1, state, next, 0.1, 5); p > 0.0)
                            self(self, frame + 1, next,
                                 score + std::log(p) + lnK[std::size_t(frame + 1)]
                                     + double(corridor.lambda[std::size_t((frame + 1) * corridor.width + cell)]));
                    }
            };
            for (Index frame = 0; frame < corridor.frameCount(); ++frame)
                for (int rate = 0; rate < axis.rateCount; ++rate)
                    for (Index cell = 0; cell < corridor.width; ++cell)
                        descend(descend, frame, {rate, cell},
                                double(corridor.lambda[std::size_t(frame * corridor.width + cell)]));
            QVERIFY(std::abs(strongestPath(corridor, axis, lnK, 5) - best) < 1e-6);
        }
    }

    // The first frames do not know how many follow by the chunks they are computed in: with nothing but noise's evidence
    // behind them, a longer corridor tells the same of them.
    void chunksChangeNothing()
    {
        const KinematicAxis axis = halfBins(400);
        Random random(5, 0);
        Corridor shorter;
        shorter.width = 13;
        for (Index frame = 0; frame < 300; ++frame)
            shorter.firstCells.push_back(100 + frame / 4);
        for (Index i = 0; i < 300 * 13; ++i)
            shorter.lambda.push_back(float(random.uniform() - 0.7));
        Corridor longer = shorter;
        for (Index frame = 300; frame < 1000; ++frame)
            longer.firstCells.push_back(175);
        longer.lambda.resize(std::size_t(1000 * 13), -3.0f);
        const Presence a = presenceIn(shorter, axis, -5.0, 0);
        const Presence b = presenceIn(longer, axis, -5.0, 0);
        for (std::size_t frame = 0; frame < 200; ++frame) {
            QVERIFY(std::abs(a.present[frame] - b.present[frame]) < 1e-4f);
            QVERIFY(std::abs(a.mean[frame] - b.mean[frame]) < 1e-3);
        }
    }

    void aLineIsThereWhileItIs()
    {
        const KinematicAxis axis = halfBins(400);
        Corridor corridor;
        corridor.width = 13;
        for (Index frame = 0; frame < 200; ++frame) {
            corridor.firstCells.push_back(50);
            for (Index cell = 0; cell < 13; ++cell)
                corridor.lambda.push_back(frame >= 60 && frame < 140 && cell == 7 ? 1.0f : -0.5f);
        }
        const Presence found = presenceIn(corridor, axis, -5.0, 0);
        for (std::size_t frame = 0; frame < 200; ++frame)
            if (frame < 50 || frame >= 150)
                QVERIFY(found.present[frame] < 0.1f);
            else if (frame >= 65 && frame < 135) {
                QVERIFY(found.present[frame] > 0.99f);
                QVERIFY(std::abs(found.mean[frame] - 57.0) < 0.1);
            }
    }

    // 20 frames before a line say nothing of it. It may have begun in any of them; only if the onset costs nothing before
    // the first frame, it seems to have been there all the time.
    void evidenceAloneDecidesWhereItBegins()
    {
        const KinematicAxis axis = halfBins(400);
        Corridor corridor;
        corridor.width = 13;
        for (Index frame = 0; frame < 100; ++frame) {
            corridor.firstCells.push_back(50);
            for (Index cell = 0; cell < 13; ++cell)
                corridor.lambda.push_back(cell != 7 ? -2.0f : frame < 20 ? 0.22f : 1.0f); // 0.22: -ln P(stay)
        }
        const std::vector<float> free = presenceIn(corridor, axis, -7.0, 0).present;
        const std::vector<float> known = presenceIn(corridor, axis, -7.0, 0, {.absentBefore = true}).present;
        QVERIFY(free[3] > 0.9f);
        QVERIFY(known[3] < 0.3f);
        QVERIFY(known[10] < 0.6f);
        QVERIFY(known[25] > 0.99f);
        QVERIFY(known[99] > 0.99f);
    }
};

FAINTLINE_TEST(tst_presence)
#include "tst_presence.moc"
