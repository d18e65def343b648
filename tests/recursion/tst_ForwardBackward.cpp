#include "base/Random.h"
#include "recursion/ForwardBackward.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;

namespace {

/// Σ over all paths of P_1 Π P Π e^λ, and the part of it that passes each state of each frame.
struct Enumeration {
    const StateSpace &space;
    const std::vector<double> &initial;
    const std::vector<double> &lambda;
    Index frames;
    std::vector<double> sums;
    double total = 0.0;
    std::vector<Index> path{};

    void run()
    {
        sums.assign(std::size_t(frames * space.stateCount()), 0.0);
        for (Index n = 0; n < space.stateCount(); ++n)
            descend(n, initial[std::size_t(n)]);
    }

    void descend(Index state, double weight)
    {
        const Index t = std::ssize(path);
        weight *= std::exp(lambda[std::size_t(t * space.cellCount() + space.cellOf(state))]);
        path.push_back(state);
        if (t + 1 == frames) {
            total += weight;
            for (Index i = 0; i < frames; ++i)
                sums[std::size_t(i * space.stateCount() + path[std::size_t(i)])] += weight;
        } else {
            for (Index next = 0; next < space.stateCount(); ++next)
                for (const StateSpace::Predecessor &p : space.predecessors(next, t + 1))
                    if (p.state == state)
                        descend(next, weight * std::exp(p.lnProbability));
        }
        path.pop_back();
    }
};

KinematicAxis axis(Index cells, bool cyclic, int firstRate, int rates, std::vector<double> change,
                   std::vector<double> step, int perCell)
{
    return {.cells = cells,
            .cyclic = cyclic,
            .firstRate = firstRate,
            .rateCount = rates,
            .rateChange = std::move(change),
            .step = std::move(step),
            .ratesPerCell = perCell};
}

} // namespace

/// The posterior against the sum over all paths, one by one.
class tst_ForwardBackward : public QObject
{
    Q_OBJECT

private slots:
    void equalsEnumeration_data()
    {
        QTest::addColumn<int>("number");
        for (const int i : {0, 1, 2, 3})
            QTest::addRow("law %d", i) << i;
    }

    void equalsEnumeration()
    {
        QFETCH(int, number);
        const std::vector<std::vector<KinematicAxis>> laws{
            {axis(5, false, -1, 3, {0.5, 0.25}, {}, 1)},
            {axis(6, true, 0, 1, {1.0}, {0.6, 0.2}, 1)},
            {axis(4, false, -1, 3, {0.8, 0.1}, {}, 2)},
            {axis(3, false, 0, 1, {1.0}, {0.6, 0.2}, 1), axis(2, false, -1, 2, {0.6, 0.2}, {}, 1)},
        };
        const StateSpace space(laws[std::size_t(number)]);
        const Index frames = 4;
        Random random(7, std::uint64_t(number));
        std::vector<float> drawn(std::size_t(frames * space.cellCount() + space.stateCount()));
        random.exponentials(drawn);
        std::vector<double> lambda(drawn.begin(), drawn.begin() + frames * space.cellCount());
        for (double &value : lambda)
            value = 2.0 * (value - 1.0);
        std::vector<double> initial(drawn.begin() + frames * space.cellCount(), drawn.end());

        Enumeration all{space, initial, lambda, frames, {}};
        all.run();
        const Posterior posterior = forwardBackward(space, initial, lambda);
        QVERIFY(std::abs(posterior.lnEvidence - std::log(all.total)) < 1e-12);
        for (std::size_t i = 0; i < all.sums.size(); ++i)
            QVERIFY(std::abs(posterior.probability[i] - all.sums[i] / all.total) < 1e-12);
    }

    void strongEvidenceElsewhereHidesNoPath()
    {
        // Cell 0 is brightest for two frames, by more than a double spans; then cell 9, which cannot be reached from there.
        const StateSpace space({axis(10, false, 0, 1, {1.0}, {0.6, 0.2}, 1)});
        std::vector<double> lambda(40, 0.0);
        lambda[0] = lambda[10] = 1000.0;
        lambda[29] = lambda[39] = 5000.0;
        const Posterior posterior = forwardBackward(space, {}, lambda);
        QVERIFY(posterior.probability[9] + posterior.probability[8] + posterior.probability[7] > 1.0 - 1e-12);
        QVERIFY(posterior.lnEvidence > 9990.0);
    }

    void whereThereIsNoPath()
    {
        const StateSpace space({axis(3, false, 0, 1, {1.0}, {1.0}, 1)});
        QVERIFY_THROWS_EXCEPTION(
            Error, forwardBackward(space, {}, std::vector<double>(6, -std::numeric_limits<double>::infinity())));
    }
};

FAINTLINE_TEST(tst_ForwardBackward)
#include "tst_ForwardBackward.moc"
