#include "frames/familyMembers.h"
#include "support/test.h"

#include "base/Random.h"
#include "frames/familyLaw.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
constexpr double eps = 2e-5; // relative, of single precision and its tables

/// -ln Q(K, x) = x - ln Σ_{j<K} x^j/j!
double minusLnQ(int members, double x)
{
    double term = 1.0, sum = 1.0;
    for (int j = 1; j < members; ++j)
        sum += term *= x / j;
    return x - std::log(sum);
}

bool isNear(double a, double b)
{
    return std::abs(a - b) <= eps * std::max({1.0, std::abs(a), std::abs(b)});
}

} // namespace

/// The joint power of a family's members: against series and formulas in double precision, and against its law on
/// noise. Where the members lie, and what they are called.
class tst_familyMembers : public QObject
{
    Q_OBJECT

private slots:
    void theSumHasTheLawOfOne_data()
    {
        QTest::addColumn<int>("members");
        for (const int members : {2, 3, 5, 8, 20, 64})
            QTest::addRow("%d", members) << members;
    }

    void theSumHasTheLawOfOne()
    {
        QFETCH(int, members);
        for (double mean = 0.25; mean < 12.0; mean *= 1.3) {
            const double sum = mean * members;
            const double expected = minusLnQ(members, double(float(sum)));
            const double got = double(powerOfSum(float(sum), std::size_t(members)));
            QVERIFY2(isNear(got, expected), qPrintable(QStringLiteral("%1: %2, %3").arg(sum).arg(got).arg(expected)));
        }
    }

    void theLargestHasTheLawOfOne()
    {
        for (const int members : {2, 3, 16, 64})
            for (double y = 0.5; y < 40.0; y *= 1.4) {
                const double below = -std::expm1(-double(float(y)));         // P(one ≤ y)
                const double above = -std::expm1(members * std::log(below)); // P(largest > y)
                const double got = double(powerOfLargest(float(y), std::size_t(members)));
                QVERIFY2(isNear(got, -std::log(above)), qPrintable(QStringLiteral("%1 of %2").arg(y).arg(members)));
            }
    }

    void oneMemberIsItself()
    {
        for (const float y : {0.0f, 0.3f, 1.0f, 17.0f, 250.0f}) {
            QCOMPARE(familyPower(FamilySettings::Present::Together, std::vector{y}), y);
            QCOMPARE(familyPower(FamilySettings::Present::InTurn, std::vector{y}), y);
        }
    }

    /// e^-y is uniform if y is exponential of mean 1: the fraction beyond each decile lies within four binomial deviations.
    void noiseStaysExponential()
    {
        constexpr int trials = 20000, members = 5;
        for (const auto present : {FamilySettings::Present::Together, FamilySettings::Present::InTurn}) {
            Random random(21, 1);
            std::vector<int> deciles(10, 0);
            for (int trial = 0; trial < trials; ++trial) {
                std::vector<float> y(members);
                for (float &value : y)
                    value = float(-std::log(1.0 - random.uniform()));
                ++deciles[std::min<std::size_t>(9, std::size_t(10.0 * std::exp(-double(familyPower(present, y)))))];
            }
            const double deviation = std::sqrt(trials * 0.1 * 0.9);
            for (const int count : deciles)
                QVERIFY2(std::abs(count - trials * 0.1) < 4.0 * deviation, qPrintable(QString::number(count)));
        }
    }

    void membersThatWereNotObservedDoNotCount()
    {
        const auto together = FamilySettings::Present::Together, inTurn = FamilySettings::Present::InTurn;
        const std::vector<float> all{2.0f, 3.0f, 7.0f}, some{2.0f, unknown, 3.0f, unknown, 7.0f};
        QCOMPARE(familyPower(together, some), familyPower(together, all));
        QCOMPARE(familyPower(inTurn, some), familyPower(inTurn, all));
        QVERIFY(std::isnan(familyPower(together, std::vector{unknown, unknown})));
        QVERIFY(std::isnan(familyPower(inTurn, std::vector{unknown, unknown})));
    }

    void channelsAreAddedBeforeTheLargestIsTaken()
    {
        const std::vector<float> y{1.0f, 2.0f, 4.0f, 0.5f, 2.5f, unknown}; // three members in two channels
        const double largest = std::max({minusLnQ(2, 3.0), minusLnQ(2, 4.5), 2.5});
        const double above = -std::expm1(3.0 * std::log(-std::expm1(-largest)));
        QVERIFY(isNear(double(familyPower(FamilySettings::Present::InTurn, y, 2)), -std::log(above)));
        QVERIFY(isNear(double(familyPower(FamilySettings::Present::Together, y, 2)), minusLnQ(5, 10.0)));
    }

    void membersLieInTheirBins()
    {
        const Axis band{"frequency", "Hz", 0.0, 0.5, 201, false}; // 0 … 100 Hz
        FamilySettings harmonics{FamilySettings::Relation::Harmonics, {1.0, 2.0, 3.0, 20.0}};
        QCOMPARE(memberBins(harmonics, 10.1, band, false), (std::vector<Index>{20, 40, 61, -1}));
        FamilySettings offsets{FamilySettings::Relation::Offsets, {-10.0, 0.0, 90.0}};
        QCOMPARE(memberBins(offsets, 10.0, band, false), (std::vector<Index>{0, 20, 200}));
        QCOMPARE(memberBins(offsets, 10.0, band, true), (std::vector<Index>{-1, 20, -1})); // but for the outer bins
    }

    void membersHaveNames()
    {
        const FamilySettings harmonics{FamilySettings::Relation::Harmonics, {1.5}};
        const FamilySettings offsets{FamilySettings::Relation::Offsets, {50.0}};
        QCOMPARE(memberName(harmonics, 1.5), std::string("1.5×"));
        QCOMPARE(memberName(offsets, 50.0), std::string("+50 Hz"));
        QCOMPARE(memberName(offsets, -50.0), std::string("-50 Hz"));
        QCOMPARE(memberName(offsets, 0.0), std::string("0 Hz"));
    }
};

FAINTLINE_TEST(tst_familyMembers)
#include "tst_familyMembers.moc"
