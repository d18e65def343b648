#include "base/Error.h"
#include "base/Random.h"
#include "detect/ModelBank.h"
#include "model/sonarModels.h"
#include "support/test.h"

using namespace faintline;

namespace {

const Grid grid{{{"range", "m", 0.0, 1.0, 40, false}, {"bearing", "°", 0.0, 1.0, 6, true}}};

std::vector<ModelBank::Member> members(double secondOffset)
{
    SonarMotion slow = nonManoeuvring();
    slow.fastestRange = 3;
    SonarMotion turning = manoeuvring(1);
    turning.fastestRange = 3;
    return {{sonarModel(grid, slow), {ResetLaw::Mean}, 0.0},
            {sonarModel(grid, turning), {ResetLaw::Mean}, secondOffset}};
}

std::vector<float> noise(std::uint64_t frame)
{
    Random random(21, frame);
    std::vector<float> y(240);
    for (float &value : y)
        value = float(random.exponential());
    return y;
}

} // namespace

/// A bank is its members, the better one in every cell.
class tst_ModelBank : public QObject
{
    Q_OBJECT

private slots:
    void isTheBestOfItsMembers()
    {
        const auto list = members(-0.5);
        ModelBank bank(list);
        Smd first(list[0].model, list[0].reset);
        Smd second(list[1].model, list[1].reset);
        std::vector<float> d(240);
        std::vector<float> a(240);
        std::vector<float> b(240);
        std::vector<int> wins(2, 0);
        for (std::uint64_t t = 0; t < 30; ++t) {
            const std::vector<float> y = noise(t);
            bank.update(y, d);
            first.update(y, a);
            second.update(y, b);
            for (std::size_t cell = 0; cell < d.size(); ++cell) {
                QCOMPARE(d[cell], std::max(a[cell], b[cell] + 0.5f));
                const std::size_t winner = b[cell] + 0.5f > a[cell] ? 1 : 0;
                QCOMPARE(bank.winnerAt(Index(cell)), winner);
                ++wins[winner];
            }
        }
        QVERIFY(wins[0] > 100 && wins[1] > 100); // both do
        QCOMPARE(bank.modelCount(), std::size_t(2));
        QVERIFY(std::equal(second.scores().begin(), second.scores().end(), bank.scores(1).begin()));
    }

    void offsetsDecideWhoWins()
    {
        ModelBank bank(members(1000.0));
        std::vector<float> d(240);
        for (std::uint64_t t = 0; t < 5; ++t)
            bank.update(noise(t), d);
        for (Index cell = 0; cell < 240; ++cell)
            QCOMPARE(bank.winnerAt(cell), std::size_t(0));
    }

    void forgetsInEveryMember()
    {
        ModelBank bank(members(0.0));
        std::vector<float> y(240, 0.5f);
        std::vector<float> d(240);
        y[20 * 6 + 3] = 100.0f;
        bank.update(y, d);
        bank.forget(grid, {{20, 3}, {1, 1}});
        bank.update(std::vector<float>(240, 0.5f), d);
        QVERIFY(*std::max_element(d.begin(), d.end()) < 2.0f);
    }

    void oneMemberIsItself()
    {
        auto list = members(0.0);
        list.pop_back();
        ModelBank bank(list);
        Smd alone(list[0].model, list[0].reset);
        std::vector<float> a(240);
        std::vector<float> b(240);
        for (std::uint64_t t = 0; t < 10; ++t) {
            bank.update(noise(t), a);
            alone.update(noise(t), b);
            QCOMPARE(a, b);
        }
        QCOMPARE(bank.regulation().lnK, alone.regulation().lnK);
    }

    void refusesOtherCells()
    {
        auto list = members(0.0);
        Grid other = grid;
        other.axes[0].count = 50;
        list[1].model = sonarModel(other, nonManoeuvring());
        QVERIFY_THROWS_EXCEPTION(Error, static_cast<void>(ModelBank(list)));
        QVERIFY_THROWS_EXCEPTION(Error, static_cast<void>(ModelBank(std::vector<ModelBank::Member>())));
    }
};

FAINTLINE_TEST(tst_ModelBank)
#include "tst_ModelBank.moc"
