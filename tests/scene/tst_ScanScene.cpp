#include "scene/ScanScene.h"
#include "support/errors.h"
#include "support/test.h"

using namespace faintline;

namespace {

std::vector<float> scan(const ScanScene &scene, Index stage, int run = 0)
{
    std::vector<float> y(std::size_t(scanGrid(scene).size()));
    readScan(scene, scanTrajectory(scene, run), run, stage, y);
    return y;
}

} // namespace

/// Simulated radar scans: what they hold, that they can be re-made one by one, and what is refused.
class tst_ScanScene : public QObject
{
    Q_OBJECT

private slots:
    void noiseIsExponential()
    {
        ScanScene scene;
        scene.hasTarget = false;
        double sum = 0.0;
        double squares = 0.0;
        double above3 = 0.0;
        double n = 0.0;
        for (Index stage = 0; stage < scene.stages; ++stage)
            for (const float y : scan(scene, stage)) {
                sum += double(y);
                squares += double(y) * double(y);
                above3 += y > 3.0f ? 1.0 : 0.0;
                n += 1.0;
            }
        QVERIFY(std::abs(sum / n - 1.0) < 4.0 / std::sqrt(n));
        QVERIFY(std::abs(squares / n - 2.0) < 4.0 * std::sqrt(20.0 / n)); // Var y² = 4! - 2!²
        const double p = std::exp(-3.0);
        QVERIFY(std::abs(above3 / n - p) < 4.0 * std::sqrt(p * (1.0 - p) / n));
    }

    void targetStandsInItsCell()
    {
        // The scan with a target is the one without, times 1 + SNR in one cell.
        ScanScene scene;
        scene.snrDb = 10.0;
        ScanScene empty = scene;
        empty.hasTarget = false;
        const std::vector<ScanCell> trajectory = scanTrajectory(scene);
        QCOMPARE(std::ssize(trajectory), Index(scene.stages));
        for (Index stage = 0; stage < scene.stages; ++stage) {
            const std::vector<float> with = scan(scene, stage);
            const std::vector<float> without = scan(empty, stage);
            const ScanCell &at = trajectory[std::size_t(stage)];
            const Index cell = scanGrid(scene).cell({at.begin(), at.end()});
            for (std::size_t i = 0; i < with.size(); ++i)
                QCOMPARE(with[i], Index(i) == cell ? 11.0f * without[i] : without[i]);
        }
    }

    void targetMovesAsAllowed_data()
    {
        QTest::addColumn<int>("moves");
        QTest::newRow("uniform") << int(ScanMoves::Uniform);
        QTest::newRow("Gaussian") << int(ScanMoves::Gaussian);
    }

    void targetMovesAsAllowed()
    {
        QFETCH(int, moves);
        ScanScene scene{.rangeCells = 4, .stages = 20000, .moves = static_cast<ScanMoves>(moves), .moveCells = 0.8};
        const std::vector<ScanCell> path = scanTrajectory(scene);
        double fromEdge = 0.0;
        double stays = 0.0;
        std::vector<double> doppler(16, 0.0);
        for (std::size_t k = 1; k < path.size(); ++k) {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                QVERIFY(path[k][axis] >= 0 && path[k][axis] < (axis == 2 ? 4 : 3));
                if (scene.moves == ScanMoves::Uniform)
                    QVERIFY(std::abs(path[k][axis] - path[k - 1][axis]) <= 1);
            }
            if (path[k - 1][2] == 0) {
                fromEdge += 1.0;
                stays += path[k][2] == 0 ? 1.0 : 0.0;
            }
            doppler[std::size_t(path[k][3])] += 1.0;
        }
        // At the edge of range: one of two, or the Gaussian's share among what exists, q(0) : q(1) : q(2) : q(3).
        const auto q = [](double d) {
            return 0.5 * (std::erf((d + 0.5) / 0.8 / std::sqrt(2.0)) - std::erf((d - 0.5) / 0.8 / std::sqrt(2.0)));
        };
        const double p = scene.moves == ScanMoves::Uniform ? 0.5 : q(0.0) / (q(0.0) + q(1.0) + q(2.0) + q(3.0));
        QVERIFY(std::abs(stays / fromEdge - p) < 4.0 * std::sqrt(p * (1.0 - p) / fromEdge));
        for (const double n : doppler)
            QVERIFY(std::abs(n - 1250.0) < 4.5 * std::sqrt(1250.0));
    }

    void anyScanAlone()
    {
        const ScanScene scene;
        const std::vector<float> seventh = scan(scene, 7);
        scan(scene, 0);
        QCOMPARE(scan(scene, 7), seventh);
        QVERIFY(scan(scene, 8) != seventh);
        QVERIFY(scan(scene, 7, 1) != seventh);
        QVERIFY(scanTrajectory(scene, 0) != scanTrajectory(scene, 1));
        ScanScene other = scene;
        other.seed = 2;
        QVERIFY(scan(other, 7) != seventh);
    }

    void withoutATarget()
    {
        ScanScene scene;
        scene.hasTarget = false;
        QVERIFY(scanTrajectory(scene).empty());
    }

    void jsonThereAndBack()
    {
        ScanScene scene{.rangeCells = 77, .hasTarget = false, .moves = ScanMoves::Gaussian, .moveCells = 1.25};
        QVERIFY(scanSceneFromJson(toJson(scene)) == scene);
        QVERIFY(scanSceneFromJson(Json::parse(R"({"kind": "scans"})")) == ScanScene());
    }

    void truthNamesItsCells()
    {
        ScanScene scene;
        scene.stages = 3;
        const Json truth = scanTruth(scene, scanTrajectory(scene));
        QCOMPARE(truth["snrDb"].get<double>(), 12.0);
        QCOMPARE(truth["axes"].dump(), std::string(R"(["azimuth","elevation","range","Doppler"])"));
        QCOMPARE(truth["cells"].size(), std::size_t(3));
        QCOMPARE(truth["cells"][0].size(), std::size_t(4));
    }

    void refusals_data()
    {
        QTest::addColumn<QByteArray>("json");
        QTest::addColumn<QString>("message");
        QTest::newRow("kind") << QByteArray(R"({"kind": "lines"})") << "kind: must be \"scans\"";
        QTest::newRow("unknown") << QByteArray(R"({"rangeCell": 3})") << "rangeCell: unknown";
        QTest::newRow("no range") << QByteArray(R"({"rangeCells": 0})") << "rangeCells = 0: must lie in 1";
        QTest::newRow("too large") << QByteArray(R"({"rangeCells": 1000000, "dopplerCells": 1000})")
                                   << "at most 2²⁸ are possible";
        QTest::newRow("too long") << QByteArray(R"({"rangeCells": 100000, "stages": 1000000})")
                                  << "more than 2³¹ values in all";
        QTest::newRow("moves") << QByteArray(R"({"moves": "fast"})")
                               << "moves = fast: must be one of uniform, gaussian";
    }

    void refusals()
    {
        QFETCH(QByteArray, json);
        QFETCH(QString, message);
        const std::string said = test::errorOf([&] { scanSceneFromJson(Json::parse(json.toStdString())); });
        QVERIFY2(test::contains(said, message.toStdString()), said.c_str());
    }
};

FAINTLINE_TEST(tst_ScanScene)
#include "tst_ScanScene.moc"
