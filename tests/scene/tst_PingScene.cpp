#include "scene/PingScene.h"
#include "scene/PingTruth.h"
#include "support/test.h"

using namespace faintline;

namespace {

PingScene smallScene()
{
    return {.pings = 10, .rangeCells = 100, .beams = 12};
}

PingTarget targetAt(double rangeCell, double beam, std::vector<PingLeg> legs)
{
    return {.rangeMetres = 3000.0 + 10.0 * rangeCell, .bearingDegrees = 30.0 * beam, .legs = std::move(legs)};
}

PingLeg leg(int pings, double rangeCells, double beams, int turn = 1)
{
    return {pings, 0.0, 0.0, rangeCells, beams, turn};
}

std::vector<Index> cellsOf(const PingScene &scene)
{
    std::vector<Index> cells;
    const PingTruth truth = pingTruth(scene);
    for (double cell : truth.targets.front().cell)
        cells.push_back(Index(cell));
    return cells;
}

Index at(Index range, Index beam)
{
    return range * 12 + beam;
}

} // namespace

/// Scenes of pings: what they say of the grid, where targets go, what is refused.
class tst_PingScene : public QObject
{
    Q_OBJECT

private slots:
    void theDefaultsAreParsons()
    {
        const Grid grid = pingGrid(PingScene{});
        QCOMPARE(grid.size(), Index(50000));
        QCOMPARE(grid.axes[0].last(), 27990.0);
        QCOMPARE(grid.axes[1].step, 18.0);
        QVERIFY(grid.axes[1].cyclic && !grid.axes[0].cyclic);
        QCOMPARE(pingTime(PingScene{}).step, 40.0);
    }

    void anArcDoesNotWrap()
    {
        PingScene scene = smallScene();
        scene.beamStepDegrees = 5.0;
        QVERIFY(!pingGrid(scene).axes[1].cyclic);
        scene.beamStepDegrees = 30.0;
        QVERIFY(pingGrid(scene).axes[1].cyclic);
    }

    void steadyTarget()
    {
        PingScene scene = smallScene();
        scene.pings = 4;
        scene.targets = {targetAt(10, 2, {leg(0, 3, 1)})};
        QCOMPARE(cellsOf(scene), (std::vector<Index>{at(10, 2), at(13, 3), at(16, 4), at(19, 5)}));
    }

    void bearingWraps()
    {
        PingScene scene = smallScene();
        scene.pings = 4;
        scene.targets = {targetAt(10, 10, {leg(0, 0, 1)})};
        QCOMPARE(cellsOf(scene), (std::vector<Index>{at(10, 10), at(10, 11), at(10, 0), at(10, 1)}));
        QCOMPARE(pingTruth(scene).targets[0].bearingDegrees, (std::vector<double>{300, 330, 0, 30}));
        scene.targets = {targetAt(10, 1, {leg(0, 0, -1)})};
        QCOMPARE(cellsOf(scene), (std::vector<Index>{at(10, 1), at(10, 0), at(10, 11), at(10, 10)}));
    }

    void fractionalRatesAdvanceNow()
    {
        PingScene scene = smallScene();
        scene.pings = 5;
        scene.targets = {targetAt(0, 0, {leg(0, 3.25, 0)})}; // 0, 3.25, 6.5, 9.75, 13
        QCOMPARE(cellsOf(scene), (std::vector<Index>{at(0, 0), at(3, 0), at(7, 0), at(10, 0), at(13, 0)}));
    }

    void physicalRatesAreCellRates()
    {
        PingScene scene = smallScene();
        PingScene physical = scene;
        scene.targets = {targetAt(10, 2, {leg(0, 3, 0.5)})};
        PingLeg own;
        own.rangeRateMetresPerSecond = 0.75;     // 3 cells of 10 m in 40 s
        own.bearingRateDegreesPerSecond = 0.375; // half a beam of 30° in 40 s
        physical.targets = {targetAt(10, 2, {own})};
        QCOMPARE(cellsOf(physical), cellsOf(scene));
    }

    void turnsSlide()
    {
        PingScene scene = smallScene();
        scene.pings = 7;
        // Rates 4 4 | 2 0 0 …: the turn from 4 to 0 takes two pings; steps are the means of neighbours: 4, 3, 1, 0, 0, 0.
        scene.targets = {targetAt(10, 0, {leg(2, 4, 0), leg(0, 0, 0, 2)})};
        QCOMPARE(cellsOf(scene),
                 (std::vector<Index>{at(10, 0), at(14, 0), at(17, 0), at(18, 0), at(18, 0), at(18, 0), at(18, 0)}));
    }

    void leavesTheRangeEdge()
    {
        PingScene scene = smallScene();
        scene.pings = 4;
        scene.targets = {targetAt(95, 0, {leg(0, 3, 0)})};
        QCOMPARE(cellsOf(scene), (std::vector<Index>{at(95, 0), at(98, 0), -1, -1}));
    }

    void appearsAndVanishes()
    {
        PingScene scene = smallScene();
        scene.targets = {targetAt(50, 0, {})};
        scene.targets[0].appearPing = 3;
        scene.targets[0].vanishPing = 6;
        const TruthTarget truth = pingTruth(scene).targets[0];
        QCOMPARE(truth.cell.size(), std::size_t(3));
        QCOMPARE(truth.cellAt(2), Index(-1));
        QCOMPARE(truth.cellAt(3), at(50, 0));
        QCOMPARE(truth.cellAt(5), at(50, 0));
        QCOMPARE(truth.cellAt(6), Index(-1));
    }

    void weavingReturns()
    {
        PingScene scene = smallScene();
        scene.pings = 21;
        scene.targets = {targetAt(50, 0, {})};
        scene.targets[0].weaveCellsPerPing = 5.0;
        const TruthTarget truth = pingTruth(scene).targets[0];
        QVERIFY(std::abs(truth.rangeMetres[20] - truth.rangeMetres[0]) < 1e-6); // a whole period
        QVERIFY(truth.rangeMetres[10] > truth.rangeMetres[0] + 250.0);
    }

    void reverberationFalls()
    {
        PingScene scene = smallScene();
        QCOMPARE(backgroundPower(scene, 5), 1.0);
        scene.reverberation = Reverberation{20.0, 2.0, PingNormalisation::Known};
        scene.rangeStepMetres = 3000.0;
        QVERIFY(std::abs(backgroundPower(scene, 0) - 101.0) < 1e-9);
        QVERIFY(std::abs(backgroundPower(scene, 1) - 26.0) < 1e-9); // twice the range, a quarter
    }

    void fourAxes()
    {
        PingScene scene = smallScene();
        scene.priSeconds = 2.0;
        scene.elevationCells = 5;
        scene.elevationStepDegrees = 3.0;
        scene.dopplerCells = 4;
        scene.firstDopplerMetresPerSecond = -15.0;
        scene.dopplerStepMetresPerSecond = 10.0;
        scene.targets = {targetAt(50, 2, {leg(4, 0, 0), leg(0, 0, 0)})};
        scene.targets[0].elevationDegrees = 3.0;
        scene.targets[0].legs[0].rangeRateMetresPerSecond = 5.0;       // a cell in a ping
        scene.targets[0].legs[0].elevationRateDegreesPerSecond = 0.75; // half a cell in a ping
        scene.targets[0].legs[1].rangeRateMetresPerSecond = -15.0;
        const Grid grid = pingGrid(scene);
        QCOMPARE(grid.axes.size(), std::size_t(4));
        QCOMPARE(grid.axes[2].name, std::string("elevation"));
        QCOMPARE(grid.axes[3].unit, std::string("m/s"));
        const TruthTarget truth = pingTruth(scene).targets[0];
        // Before the turn it approaches the next Doppler cell at 5 m/s; from ping 4 on it closes at 15 m/s.
        QCOMPARE(grid.coordinates(truth.cellAt(0)), (std::vector<Index>{50, 2, 1, 2}));
        QCOMPARE(grid.coordinates(truth.cellAt(2)), (std::vector<Index>{52, 2, 2, 2}));
        QCOMPARE(grid.coordinates(truth.cellAt(4)), (std::vector<Index>{52, 2, 3, 0}));
        QCOMPARE(grid.coordinates(truth.cellAt(6)), (std::vector<Index>{46, 2, 3, 0}));
        QCOMPARE(truth.positionOn(3, grid, 0), 5.0);
        QCOMPARE(truth.positionOn(2, grid, 1), 4.5);
        TruthTarget other = truth; // of a grid with axes of its own, only the cells are known
        other.dopplerMetresPerSecond.clear();
        QCOMPARE(other.positionOn(3, grid, 0), grid.axes[3].value(2));
        QVERIFY(pingSceneFromJson(toJson(scene)) == scene);
        QVERIFY(pingTruthFromJson(toJson(pingTruth(scene))) == pingTruth(scene));
        PingScene flat = smallScene();
        flat.targets = {targetAt(50, 2, {})};
        QVERIFY(toJson(pingTruth(flat)).dump().find("elevation") == std::string::npos);
        // A target faster than the Doppler axis is silent.
        scene.targets[0].legs[0].rangeRateMetresPerSecond = 50.0;
        QCOMPARE(pingTruth(scene).targets[0].cellAt(1), Index(-1));
    }

    void jsonRoundTrip()
    {
        PingScene scene = smallScene();
        scene.looks = 4;
        scene.reverberation = Reverberation{15.0, 2.5, PingNormalisation::Estimated};
        scene.targets = {targetAt(10, 2, {leg(5, 3, 1), leg(0, -2, 0, 4)}), targetAt(20, 3, {})};
        scene.targets[1].echo = Echo::Complex;
        scene.targets[1].fluctuation = Fluctuation::Swerling4;
        QVERIFY(pingSceneFromJson(toJson(scene)) == scene);
        QVERIFY(isPingScene(toJson(scene)));
        QVERIFY(!isPingScene(Json::parse(R"({"kind": "lines"})")));
        QVERIFY(!isPingScene(Json::parse("[1]")));
    }

    void truthRoundTrip()
    {
        PingScene scene = smallScene();
        scene.targets = {targetAt(95, 11, {leg(0, 1.5, 0.3)})};
        const PingTruth truth = pingTruth(scene);
        QVERIFY(pingTruthFromJson(toJson(truth)) == truth);
        Json broken = toJson(truth);
        broken["targets"][0]["cell"].erase(0);
        QVERIFY_THROWS_EXCEPTION(Error, pingTruthFromJson(broken));
    }

    void refusals_data()
    {
        QTest::addColumn<QString>("json");
        QTest::addColumn<QString>("where");
        QTest::newRow("kind") << R"({"kind": "lines"})"
                              << "kind";
        QTest::newRow("unknown key") << R"({"kind": "pings", "beans": 3})"
                                     << "beans";
        QTest::newRow("too many cells") << R"({"kind": "pings", "rangeCells": 1000000, "beams": 1000})"
                                        << "rangeCells";
        QTest::newRow("more than a turn") << R"({"kind": "pings", "beams": 20, "beamStepDegrees": 20})"
                                          << "beamStepDegrees";
        QTest::newRow("range outside") << R"({"kind": "pings", "targets": [{"rangeMetres": 100}]})"
                                       << "targets[0].rangeMetres";
        QTest::newRow("vanishes first")
            << R"({"kind": "pings", "targets": [{"rangeMetres": 4000, "appearPing": 9, "vanishPing": 5}]})"
            << "targets[0].vanishPing";
        QTest::newRow("appears too late")
            << R"({"kind": "pings", "pings": 5, "targets": [{"rangeMetres": 4000, "appearPing": 5}]})"
            << "targets[0].appearPing";
        QTest::newRow("endless leg before another")
            << R"({"kind": "pings", "targets": [{"rangeMetres": 4000, "legs": [{}, {"pings": 3}]}]})"
            << "targets[0].legs[0].pings";
        QTest::newRow("legs not a list") << R"({"kind": "pings", "targets": [{"rangeMetres": 4000, "legs": 3}]})"
                                         << "targets[0].legs";
        QTest::newRow("target not an object") << R"({"kind": "pings", "targets": [3]})"
                                              << "targets[0]";
        QTest::newRow("echo") << R"({"kind": "pings", "targets": [{"rangeMetres": 4000, "echo": "loud"}]})"
                              << "targets[0].echo";
        QTest::newRow("fluctuation")
            << R"({"kind": "pings", "targets": [{"rangeMetres": 4000, "fluctuation": "case 1"}]})"
            << "targets[0].fluctuation";
        QTest::newRow("fluctuates twice")
            << R"({"kind": "pings", "targets": [{"rangeMetres": 4000, "echo": "fluctuating", "fluctuation": "swerling1"}]})"
            << "targets[0].fluctuation";
        QTest::newRow("too many cells of four axes")
            << R"({"kind": "pings", "rangeCells": 1000, "beams": 100, "elevationCells": 10, "dopplerCells": 100})"
            << "rangeCells";
        QTest::newRow("estimates on more axes")
            << R"({"kind": "pings", "elevationCells": 4, "reverberation": {"normalisation": "estimated"}})"
            << "reverberation.normalisation";
        QTest::newRow("reverberation at no range") << R"({"kind": "pings", "firstRangeMetres": 0, "reverberation": {}})"
                                                   << "firstRangeMetres";
    }

    void refusals()
    {
        QFETCH(QString, json);
        QFETCH(QString, where);
        try {
            pingSceneFromJson(Json::parse(json.toStdString()));
            QFAIL("accepted");
        } catch (const Error &error) {
            QVERIFY2(QString::fromStdString(error.where()).startsWith(where), error.what());
        }
    }
};

FAINTLINE_TEST(tst_PingScene)
#include "tst_PingScene.moc"
