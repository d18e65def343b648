#include "base/Error.h"
#include "base/Random.h"
#include "frames/Family.h"
#include "support/errors.h"
#include "support/test.h"

#include <boost/math/special_functions/gamma.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace faintline;

namespace {

constexpr Index bins = 400;

Axis band()
{
    return {"frequency", "Hz", 0.0, 0.5, bins, false};
}

FamilySettings family(FamilySettings::Relation relation, std::vector<double> members,
                      FamilySettings::Present present = FamilySettings::Present::Together)
{
    return {relation, std::move(members), present};
}

std::vector<float> noise(std::uint64_t stream)
{
    std::vector<float> y(static_cast<std::size_t>(bins));
    Random random(5, stream);
    random.exponentials(y);
    return y;
}

std::vector<float> applied(const FamilyMap &map, const std::vector<float> &y)
{
    std::vector<float> out(std::size_t(map.frequency().count));
    map.apply(y, out);
    return out;
}

} // namespace

/// Lines that are looked for as one.
class tst_Family : public QObject
{
    Q_OBJECT

private slots:
    void sumsSidebands()
    {
        const FamilyMap map(family(FamilySettings::Relation::Offsets, {-20.0, 0.0, 20.0}), band(), false);
        QCOMPARE(map.frequency(), band());
        const std::vector<float> y = noise(0);
        const std::vector<float> out = applied(map, y);
        for (Index cell = 0; cell < bins; ++cell) {
            double sum = 0.0;
            double count = 0.0;
            for (const Index member : {cell - 40, cell, cell + 40})
                if (member >= 0 && member < bins) {
                    sum += double(y[std::size_t(member)]);
                    count += 1.0;
                }
            const double expected = -std::log(boost::math::gamma_q(count, sum));
            QVERIFY(std::abs(double(out[std::size_t(cell)]) - expected) < 2e-3 * std::max(0.1, expected));
        }
    }

    void takesTheLargestTone()
    {
        const FamilyMap map(
            family(FamilySettings::Relation::Offsets, {0.0, 1.0, 2.0, 3.0}, FamilySettings::Present::InTurn), band(),
            false);
        std::vector<float> y = noise(1);
        y[50] = 40.0f; // far beyond what 1 - e^-m still tells apart
        const std::vector<float> out = applied(map, y);
        for (std::size_t cell : {std::size_t(50), std::size_t(60), std::size_t(200)}) {
            const double m = double(std::max({y[cell], y[cell + 2], y[cell + 4], y[cell + 6]}));
            const double expected = m > 20.0 ? m - std::log(4.0) : -std::log(1.0 - std::pow(1.0 - std::exp(-m), 4.0));
            QVERIFY(std::abs(double(out[cell]) - expected) < 1e-4 * std::max(1.0, expected));
        }
    }

    void placesHarmonicsToTheNearestBin()
    {
        const FamilyMap map(family(FamilySettings::Relation::Harmonics, {1.0, 2.0, 5.0}), band(), false);
        QCOMPARE(map.frequency().step, 0.1); // the fifth harmonic moves by a bin
        std::vector<float> y(std::size_t(bins), 0.0f);
        const double fundamental = 17.3;
        for (const double member : {1.0, 2.0, 5.0})
            y[std::size_t(std::lround(member * fundamental / 0.5))] = 10.0f;
        const std::vector<float> out = applied(map, y);
        const auto best = std::max_element(out.begin(), out.end()) - out.begin();
        QVERIFY(std::abs(map.frequency().value(double(best)) - fundamental) <= 0.1);
        QVERIFY(std::abs(double(out[std::size_t(best)]) + std::log(boost::math::gamma_q(3.0, 30.0))) < 0.1);
        // The highest fundamental has all of its members in the band.
        QVERIFY(5.0 * map.frequency().last() <= band().last() + 1e-9);
        QVERIFY(5.0 * (map.frequency().last() + map.frequency().step) > band().last());
        const Axis narrow{"frequency", "Hz", 0.0, 0.5, 40, false};
        QVERIFY_EXCEPTION_THROWN(FamilyMap(family(FamilySettings::Relation::Harmonics, {32.0, 64.0}), narrow, false),
                                 Error);
    }

    void keepsTheLawOfNoise_data()
    {
        QTest::addColumn<FamilySettings>("settings");
        using enum FamilySettings::Relation;
        using enum FamilySettings::Present;
        QTest::newRow("sidebands") << family(Offsets, {-7.0, 0.0, 7.0});
        QTest::newRow("sixteen harmonics")
            << family(Harmonics, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});
        QTest::newRow("tones in turn") << family(Offsets, {0.0, 1.5, 3.0, 4.5}, InTurn);
    }

    /// P(y > t) = e^-t, in every cell, whatever number of members lies in the band.
    void keepsTheLawOfNoise()
    {
        QFETCH(FamilySettings, settings);
        const FamilyMap map(settings, band(), true);
        constexpr int frames = 3000;
        std::vector<double> above(4, 0.0);
        double cells = 0.0;
        for (int frame = 0; frame < frames; ++frame)
            for (const float value : applied(map, noise(std::uint64_t(100 + frame)))) {
                if (std::isnan(value)) // nothing of the family in the band
                    continue;
                cells += 1.0;
                for (std::size_t i = 0; i < above.size(); ++i)
                    above[i] += value > 0.5f + 2.0f * float(i) ? 1.0 : 0.0;
            }
        for (std::size_t i = 0; i < above.size(); ++i) {
            const double expected = std::exp(-0.5 - 2.0 * double(i));
            // Cells of a frame share members: at most one in 40 is counted as independent.
            const double deviation = std::sqrt(expected * 40.0 / cells);
            QVERIFY2(std::abs(above[i] / cells - expected) < 4.0 * deviation + 1e-3 * expected,
                     qPrintable(QString("%1: %2 of %3").arg(i).arg(above[i] / cells).arg(expected)));
        }
    }

    void leavesOutWhatWasNotObserved()
    {
        const FamilyMap map(family(FamilySettings::Relation::Offsets, {0.0, 10.0}), band(), false);
        std::vector<float> y = noise(2);
        y[100] = std::numeric_limits<float>::quiet_NaN();
        std::vector<float> out = applied(map, y);
        QVERIFY(std::abs(out[100] - y[120]) < 1e-6f); // one of its two members is left
        y[120] = std::numeric_limits<float>::quiet_NaN();
        out = applied(map, y);
        QVERIFY(std::isnan(out[100]));
    }

    void closesOnItself()
    {
        const FamilyMap near = FamilyMap::onRing(family(FamilySettings::Relation::Offsets, {0.0, 5.0}), bins, 2.0);
        std::vector<float> y(std::size_t(bins), 0.0f);
        y[3] = 8.0f;
        const std::vector<float> out = applied(near, y);
        QVERIFY(out[3] > 5.0f && out[std::size_t(bins - 7)] > 5.0f && out[13] < 0.1f);
        // Members farther apart than the ring is wide share no bin.
        const FamilyMap far = FamilyMap::onRing(family(FamilySettings::Relation::Offsets, {0.0, 200.0}), bins, 2.0);
        QCOMPARE(far.frequency().count, bins / 2);
        const std::vector<float> spread = applied(far, y);
        QCOMPARE(std::count_if(spread.begin(), spread.end(), [](float value) { return value > 1.0f; }), 1);
    }

    void refusesWhatIsNoFamily_data()
    {
        QTest::addColumn<FamilySettings>("settings");
        QTest::addColumn<QString>("why");
        using enum FamilySettings::Relation;
        QTest::newRow("no members") << family(Harmonics, {}) << "at least one member";
        QTest::newRow("a multiple of 0") << family(Harmonics, {0.0, 1.0}) << "must lie above 0";
        std::vector<double> many;
        for (int i = 0; i < 65; ++i)
            many.push_back(i);
        QTest::newRow("too many") << family(Offsets, many) << "at most 64";
        QTest::newRow("one twice") << family(Offsets, {0.0, 50.0, 0.0}) << "twice";
        QTest::newRow("less than a bin apart") << family(Offsets, {0.0, 0.3}) << "at least a bin apart";
        QTest::newRow("outside") << family(Offsets, {5000.0}) << "at least one member in the band";
    }

    void refusesWhatIsNoFamily()
    {
        QFETCH(FamilySettings, settings);
        QFETCH(QString, why);
        const Axis hz{"frequency", "Hz", 100.0, 0.5, 100, false};
        const std::string said = test::errorOf([&] { FamilyMap(settings, hz, false); });
        QVERIFY2(test::contains(said, why.toStdString()), said.c_str());
    }
};

FAINTLINE_TEST(tst_Family)
#include "tst_Family.moc"
