#include "base/Random.h"
#include "refine/assign.h"
#include "support/test.h"

#include <algorithm>
#include <functional>

using namespace faintline;

namespace {

constexpr double unassigned = 10.0;

/// The least cost of all assignments, one after the other.
double leastCost(const std::vector<PairCost> &pairs, std::size_t froms, std::size_t tos)
{
    double least = 1e9;
    std::vector<bool> isTaken(tos);
    const std::function<void(std::size_t, double)> descend = [&](std::size_t from, double cost) {
        if (from == froms) {
            least = std::min(least, cost);
            return;
        }
        descend(from + 1, cost + unassigned);
        for (const PairCost &pair : pairs)
            if (pair.from == from && !isTaken[pair.to]) {
                isTaken[pair.to] = true;
                descend(from + 1, cost + pair.cost);
                isTaken[pair.to] = false;
            }
    };
    descend(0, 0.0);
    return least;
}

} // namespace

/// Assignments of minimal cost, against enumeration.
class tst_assign : public QObject
{
    Q_OBJECT

private slots:
    void asCheapAsCanBe_data();
    void asCheapAsCanBe();
    void nothingForNothing();
    void neverWhatIsTooDear();
};

void tst_assign::asCheapAsCanBe_data()
{
    QTest::addColumn<int>("froms");
    QTest::addColumn<int>("tos");
    QTest::addColumn<double>("density");
    QTest::newRow("a full square") << 5 << 5 << 1.0;
    QTest::newRow("few to choose from") << 6 << 3 << 1.0;
    QTest::newRow("many to choose from") << 3 << 6 << 1.0;
    QTest::newRow("several components") << 6 << 6 << 0.25;
}

void tst_assign::asCheapAsCanBe()
{
    QFETCH(int, froms);
    QFETCH(int, tos);
    QFETCH(double, density);
    Random random(3, 0);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<PairCost> pairs;
        for (int from = 0; from < froms; ++from)
            for (int to = 0; to < tos; ++to)
                if (random.uniform() < density)
                    pairs.push_back({std::size_t(from), std::size_t(to), 14.0 * random.uniform() - 2.0});
        std::vector<bool> isGiven(static_cast<std::size_t>(froms));
        std::vector<bool> isTaken(static_cast<std::size_t>(tos));
        double cost = unassigned * froms;
        for (const std::size_t chosen : assign(pairs, unassigned)) {
            const PairCost &pair = pairs[chosen];
            QVERIFY(!isGiven[pair.from] && !isTaken[pair.to]);
            isGiven[pair.from] = isTaken[pair.to] = true;
            cost += pair.cost - unassigned;
        }
        QVERIFY(std::abs(cost - leastCost(pairs, std::size_t(froms), std::size_t(tos))) < 1e-9);
    }
}

void tst_assign::nothingForNothing()
{
    QVERIFY(assign({}, unassigned).empty());
}

void tst_assign::neverWhatIsTooDear()
{
    QVERIFY(assign({{0, 0, unassigned}, {0, 1, 2.0 * unassigned}, {1, 1, 11.0}}, unassigned).empty());
}

FAINTLINE_TEST(tst_assign)
#include "tst_assign.moc"
