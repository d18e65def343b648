#include "scene/editTargets.h"
#include "support/test.h"

#include "scene/PingTruth.h"

#include <cmath>

using namespace faintline;

namespace {

/// 200 cells of 10 m from 1000 m, 20 beams of 18°, a ping every 10 s: 1 cell/ping = 1 m/s, 1 beam/ping = 1.8 °/s.
PingScene smallSea()
{
    return {.pings = 50, .priSeconds = 10.0, .rangeCells = 200, .firstRangeMetres = 1000.0, .rangeStepMetres = 10.0};
}

/// Three legs, the second of which is turned into over four pings.
PingTarget turningTarget()
{
    PingTarget target{.rangeMetres = 2000.0, .bearingDegrees = 90.0, .appearPing = 3};
    target.legs = {{.pings = 10, .rangeCellsPerPing = 2.0},
                   {.pings = 12, .rangeCellsPerPing = -1.0, .beamsPerPing = 0.1, .turnPings = 4},
                   {.pings = 8, .rangeCellsPerPing = 3.0}};
    return target;
}

/// Where the simulated target is in a ping.
ScenePlace placeIn(const PingScene &scene, const PingTarget &target, int ping)
{
    PingScene alone = scene;
    alone.targets = {target};
    const TruthTarget truth = pingTruth(alone).targets.front();
    const auto k = std::size_t(ping - truth.firstPing);
    return {truth.rangeMetres[k], truth.bearingDegrees[k]};
}

double apart(double a, double b, double turn)
{
    return std::abs(std::remainder(a - b, turn));
}

} // namespace

class tst_editTargets : public QObject
{
    Q_OBJECT

private slots:
    void cornersLieOnThePath()
    {
        const PingScene scene = smallSea();
        const std::vector<TargetCorner> corners = cornersOf(scene, turningTarget());
        QCOMPARE(corners.size(), std::size_t(4));
        const int pings[] = {3, 13, 25, 33};
        for (std::size_t i = 0; i < corners.size(); ++i) {
            QCOMPARE(corners[i].ping, pings[i]);
            const ScenePlace place = placeIn(scene, turningTarget(), pings[i]);
            QCOMPARE(corners[i].place.rangeMetres, place.rangeMetres);
            QCOMPARE(corners[i].place.bearingDegrees, place.bearingDegrees);
        }
        // By hand: ten pings at 2 cells, the last of which already turns by a quarter of -3 cells, half a ping of it.
        QCOMPARE(corners[1].place.rangeMetres, 2000.0 + 10.0 * (20.0 - 0.375));
    }

    void cornersEndWithTheScene()
    {
        PingScene scene = smallSea();
        scene.pings = 20;
        const std::vector<TargetCorner> corners = cornersOf(scene, turningTarget());
        QCOMPARE(corners.size(), std::size_t(3)); // the third leg begins after the end
        QCOMPARE(corners.back().ping, 19);
        PingTarget open = turningTarget();
        open.legs.resize(1);
        open.legs[0].pings = 0;
        QCOMPARE(cornersOf(scene, open).back().ping, 19);
        open.vanishPing = 8;
        QCOMPARE(cornersOf(scene, open).back().ping, 7);
        scene.pings = 2;
        QVERIFY(cornersOf(scene, open).empty());
    }

    void aMovedCornerIsWhereItWasPut_data()
    {
        QTest::addColumn<int>("corner");
        QTest::addColumn<bool>("isPerPing");
        for (int corner = 0; corner < 4; ++corner)
            for (const bool isPerPing : {false, true})
                QTest::addRow("corner %d, %s", corner, isPerPing ? "cells" : "m/s") << corner << isPerPing;
    }

    void aMovedCornerIsWhereItWasPut()
    {
        QFETCH(int, corner);
        QFETCH(bool, isPerPing);
        const PingScene scene = smallSea();
        const PingTarget before = turningTarget();
        const ScenePlace to{2345.0, 117.0};
        const PingTarget after =
            withCornerAt(scene, before, std::size_t(corner), to, isPerPing ? RateUnit::PerPing : RateUnit::PerSecond);
        const ScenePlace now = placeIn(scene, after, cornersOf(scene, before)[std::size_t(corner)].ping);
        QVERIFY2(std::abs(now.rangeMetres - to.rangeMetres) <= 1.0, qPrintable(QString::number(now.rangeMetres)));
        QVERIFY2(apart(now.bearingDegrees, to.bearingDegrees, 360.0) <= 1.8,
                 qPrintable(QString::number(now.bearingDegrees)));
    }

    void onlyItsOwnLegChanges()
    {
        const PingScene scene = smallSea();
        const PingTarget before = turningTarget();
        const PingTarget after = withCornerAt(scene, before, 2, {2100.0, 60.0}, RateUnit::PerPing);
        QCOMPARE(after.legs[0], before.legs[0]);
        QVERIFY(!(after.legs[1] == before.legs[1]));
        QCOMPARE(after.legs[2], before.legs[2]);
        QCOMPARE(after.legs[1].pings, before.legs[1].pings);
        QCOMPARE(after.legs[1].turnPings, before.legs[1].turnPings);
    }

    void theStartMovesTheWholeTarget()
    {
        const PingScene scene = smallSea();
        const PingTarget after = withCornerAt(scene, turningTarget(), 0, {1803.0, 100.0}, RateUnit::PerPing);
        QCOMPARE(after.rangeMetres, 1803.0);
        QCOMPARE(after.bearingDegrees, 100.0);
        QCOMPARE(after.legs, turningTarget().legs);
    }

    void aLegTakesTheShorterWayRound()
    {
        const PingScene scene = smallSea();
        PingTarget target{.rangeMetres = 2000.0, .bearingDegrees = 10.0};
        const PingTarget after = withLegTo(scene, target, {2000.0, 340.0}, RateUnit::PerSecond);
        QCOMPARE(after.legs[0].bearingRateDegreesPerSecond, -0.15); // -30° in 20 pings of 10 s
    }

    void placesAreClampedToTheMap()
    {
        const PingScene scene = smallSea();
        const PingTarget after = withCornerAt(scene, turningTarget(), 0, {99999.0, 400.0}, RateUnit::PerPing);
        QCOMPARE(after.rangeMetres, 2990.0);
        QCOMPARE(after.bearingDegrees, 40.0);
        PingScene sector = scene;
        sector.beams = 5;
        sector.beamStepDegrees = 2.0;
        QCOMPARE(withCornerAt(sector, turningTarget(), 0, {500.0, 40.0}, RateUnit::PerPing).bearingDegrees, 8.0);
        QCOMPARE(withCornerAt(scene, turningTarget(), 9, {1500.0, 40.0}, RateUnit::PerPing), turningTarget());
    }

    void legsAreAddedAtTheEnd()
    {
        const PingScene scene = smallSea();
        PingTarget target{.rangeMetres = 2000.0, .bearingDegrees = 90.0, .appearPing = 20};
        target = withLegTo(scene, target, {2100.0, 90.0}, RateUnit::PerPing);
        QCOMPARE(target.legs.size(), std::size_t(1));
        QCOMPARE(target.legs[0], (PingLeg{.pings = usualLegPings, .rangeCellsPerPing = 0.5}));
        target = withLegTo(scene, target, {2100.0, 120.0}, RateUnit::PerPing);
        QCOMPARE(target.legs[1].pings, 9); // the scene has 50 pings
        QCOMPARE(target.legs[0].rangeCellsPerPing, 0.5);
        const ScenePlace end = placeIn(scene, target, 49);
        QVERIFY(std::abs(end.rangeMetres - 2100.0) <= 1.0);
        QVERIFY(std::abs(end.bearingDegrees - 120.0) <= 1.8);
    }

    void legsWithoutAPingAreRefused()
    {
        const PingScene scene = smallSea();
        PingTarget target{.rangeMetres = 2000.0, .appearPing = 49};
        const auto why = [&] {
            try {
                withLegTo(scene, target, {2100.0, 0.0}, RateUnit::PerPing);
            } catch (const Error &error) {
                return QString(error.what());
            }
            return QString();
        };
        QVERIFY2(why().contains("no ping left before ping 50"), qPrintable(why()));
        target.appearPing = 0;
        target.legs = {PingLeg()};
        QVERIFY2(why().startsWith("leg 1: lasts to the end"), qPrintable(why()));
    }

    void ratesInBothUnitsAddUp()
    {
        PingScene scene = smallSea();
        QCOMPARE(rateUnitOf(scene), RateUnit::PerSecond);
        PingLeg leg{.rangeRateMetresPerSecond = 3.0,
                    .bearingRateDegreesPerSecond = 0.9,
                    .rangeCellsPerPing = 1.0,
                    .beamsPerPing = 0.25};
        QCOMPARE(rangeRateOf(leg, scene, RateUnit::PerPing), 4.0);
        QCOMPARE(rangeRateOf(leg, scene, RateUnit::PerSecond), 4.0);
        QCOMPARE(bearingRateOf(leg, scene, RateUnit::PerPing), 0.75);
        QCOMPARE(bearingRateOf(leg, scene, RateUnit::PerSecond), 1.35);
        setRangeRate(leg, 2.0, RateUnit::PerPing);
        setBearingRate(leg, 2.0, RateUnit::PerSecond);
        QCOMPARE(leg, (PingLeg{.bearingRateDegreesPerSecond = 2.0, .rangeCellsPerPing = 2.0}));
        scene.targets.emplace_back().legs = {leg};
        QCOMPARE(rateUnitOf(scene), RateUnit::PerPing);
    }

    void draggedRatesHaveFewDigits()
    {
        const PingScene scene = smallSea();
        const PingTarget after = withCornerAt(scene, turningTarget(), 3, {2123.4567, 98.7654321}, RateUnit::PerPing);
        const double rate = after.legs[2].rangeCellsPerPing;
        QVERIFY(std::abs(std::round(rate * 100.0) / 100.0 - rate) < 1e-12); // a tenth of a cell in eight pings
    }
};

FAINTLINE_TEST(tst_editTargets)
#include "tst_editTargets.moc"
