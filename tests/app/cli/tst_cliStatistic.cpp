#include "app/cli/CommandLineTest.h"
#include "signal/formats/NumPy.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// statistic: the recursion alone on frames, against vectors worked out elsewhere and by eye.
class tst_cliStatistic : public CommandLineTest
{
    Q_OBJECT

private slots:
    void billonsVectors_data();
    void billonsVectors();
    void parsonsVectors();
    void lnLambdaByEye();
    void mistakesInFrames_data();
    void mistakesInFrames();
};

namespace {

QByteArray shared(const char *name)
{
    return readBytes(std::string(FAINTLINE_SOURCE_DIR "/../shared/vectors/") + name);
}

} // namespace

void tst_cliStatistic::billonsVectors_data()
{
    QTest::addColumn<QByteArray>("axis");
    QTest::addColumn<double>("lnK");
    QTest::addColumn<int>("column"); ///< of outputs.csv
    QTest::addColumn<int>("states");
    QTest::newRow("stable, K = 0.92") << QByteArray(R"("rates": [0], "rateChange": [1])") << std::log(0.92) << 4 << 16;
    QTest::newRow("5 slopes, K = 2") << QByteArray(
        R"("rates": [-2, -1, 0, 1, 2], "rateChange": [0.3333333333333333, 0.3333333333333333])")
                                     << std::log(2.0) << 5 << 80;
}

void tst_cliStatistic::billonsVectors()
{
    QFETCH(QByteArray, axis);
    QFETCH(double, lnK);
    QFETCH(int, column);
    QFETCH(int, states);
    const auto expected = numbersOf(shared("billon/outputs.csv"));
    if (expected.empty())
        QSKIP("skipped: no ../shared");
    QCOMPARE(expected.size(), std::size_t(12 * 16));
    std::vector<float> y;
    for (const auto &row : expected)
        y.push_back(float(row[2]));
    writeArray(pathOf("billon.npy"), {12, 16}, y);
    writeBytes(pathOf("billon.json"),
               R"({"axes": [{"name": "frequency", "cells": 16, )" + axis
                   + R"(}], "likelihood": {"kind": "rice", "r0": 0.5}, "reset": {"law": "fixed", "lnK": )"
                   + QByteArray::number(lnK, 'g', 17) + "}}");
    const Outcome done = run(
        {"statistic", "--frames", "billon.npy", "--model", "billon.json", "--out", "L.npy", "--projected", "P.npy"});
    QCOMPARE(done.err, QByteArray());
    QCOMPARE(done.code, 0);
    const NumPyArray L = readNumPy(pathOf("L.npy"));
    const NumPyArray projected = readNumPy(pathOf("P.npy"));
    QCOMPARE(L.shape, (std::vector<Index>{12, states / 16, 16}));
    QCOMPARE(projected.shape, (std::vector<Index>{12, 16}));
    for (std::size_t i = 0; i < expected.size(); ++i) {
        // The vectors' ln Λ starts from ln P_n = -ln N; L = ln NΛ.
        const double wanted = expected[i][std::size_t(column)] + std::log(states);
        QVERIFY2(std::abs(double(projected.values[i]) - wanted) < 1e-5,
                 qPrintable(QString("frame %1, bin %2: %3, vector %4")
                                .arg(i / 16)
                                .arg(i % 16)
                                .arg(double(projected.values[i]))
                                .arg(wanted)));
        float largest = -INFINITY;
        for (std::size_t rate = 0; rate < std::size_t(states / 16); ++rate)
            largest = std::max(largest, L.values[(i / 16 * std::size_t(states / 16) + rate) * 16 + i % 16]);
        QCOMPARE(projected.values[i], largest);
    }
}

void tst_cliStatistic::parsonsVectors()
{
    const auto input = numbersOf(shared("parsons/input.csv"));
    const auto expected = numbersOf(shared("parsons/expected_non.csv"));
    if (input.empty() || expected.empty())
        QSKIP("skipped: no ../shared");
    // Axes in the vectors' order of a state: range, bearing.
    std::vector<float> y(6 * 24 * 6);
    for (const auto &row : input)
        for (std::size_t range = 0; range < 24; ++range)
            y[std::size_t(row[0]) * 144 + range * 6 + std::size_t(row[1])] = float(row[2 + range]);
    writeArray(pathOf("pings.npy"), {6, 24, 6}, y);
    writeBytes(
        pathOf("parsons.json"),
        R"({"axes": [{"name": "range", "cells": 24, "rates": [-2, -1, 0, 1, 2], "rateChange": [1], "round": "trunc"},
        {"name": "bearing", "cells": 6, "cyclic": true, "rates": [-1, 0, 1], "rateChange": [1], "round": "trunc"}],
        "likelihood": {"kind": "linear"}, "reset": {"law": "mean"}})");
    const Outcome done =
        run({"statistic", "--frames", "pings.npy", "--model", "parsons.json", "--out", "LP.npy", "--log", "K.csv"});
    QCOMPARE(done.err, QByteArray());
    QCOMPARE(done.code, 0);
    const NumPyArray L = readNumPy(pathOf("LP.npy"));
    QCOMPARE(L.shape, (std::vector<Index>{6, 5, 3, 24, 6}));
    QVERIFY(content("K.csv").startsWith("frame,lnK,reset_fraction,max_statistic\n"));
    const auto log = numbersOf(content("K.csv"));
    QCOMPARE(log.size(), std::size_t(6));
    std::vector<double> largest(6, -INFINITY);
    for (const auto &row : expected) { // ping, K, reset, r, b, u, v, lnL
        const auto ping = std::size_t(row[0]);
        const auto rate = std::size_t((row[5] + 2.0) * 3.0 + row[6] + 1.0);
        const auto cell = std::size_t(row[3] * 6.0 + row[4]);
        const auto found = double(L.values[(ping * 15 + rate) * 144 + cell]);
        QVERIFY2(std::abs(found - row[7]) < 1e-4,
                 qPrintable(QString("ping %1: %2, vector %3").arg(ping).arg(found).arg(row[7])));
        QVERIFY(std::abs(log[ping][1] - row[1]) < 1e-5);
        QVERIFY(std::abs(log[ping][2] - row[2]) < 1e-9);
        largest[ping] = std::max(largest[ping], row[7]);
    }
    for (std::size_t ping = 0; ping < 6; ++ping)
        QVERIFY(std::abs(log[ping][3] - largest[ping]) < 1e-4);
}

void tst_cliStatistic::lnLambdaByEye()
{
    // Two cells, nothing moves, λ = y, ln K = -1: L = y + max(L - 1, 0).
    writeArray(pathOf("eye.npy"), {3, 2}, {0.5f, 3.0f, 1.0f, 0.0f, 0.25f, 2.0f});
    writeBytes(pathOf("eye.json"),
               R"({"axes": [{"cells": 2}], "likelihood": {"kind": "linear"}, "reset": {"law": "fixed", "lnK": -1}})");
    QCOMPARE(
        run({"statistic", "--frames", "eye.npy", "--model", "eye.json", "--out", "eyeL.npy", "--log", "eye.csv"}).code,
        0);
    QCOMPARE(readNumPy(pathOf("eyeL.npy")).values, (std::vector<float>{0.5f, 3.0f, 1.0f, 2.0f, 0.25f, 3.0f}));
    QCOMPARE(content("eye.csv"),
             QByteArray("frame,lnK,reset_fraction,max_statistic\n0,-1,1,3\n1,-1,0.5,2\n2,-1,0.5,3\n"));

    // The lowest cell at rate 1 has no predecessor, and there is no reset.
    writeBytes(pathOf("none.json"),
               R"({"axes": [{"cells": 2, "rates": [1], "rateChange": [1]}], "likelihood": {"kind": "linear"},
        "reset": {"law": "none"}})");
    QCOMPARE(run({"statistic", "--frames", "eye.npy", "--model", "none.json", "--out", "noneL.npy"}).code, 0);
    QCOMPARE(readNumPy(pathOf("noneL.npy")).values,
             (std::vector<float>{0.5f, 3.0f, -INFINITY, 0.5f, -INFINITY, -INFINITY}));

    // All paths counted: with one state it is the same sum.
    writeArray(pathOf("one.npy"), {3, 1}, {0.5f, 3.0f, 1.0f});
    writeBytes(
        pathOf("sum.json"),
        R"({"axes": [{"cells": 1}], "likelihood": {"kind": "linear"}, "reset": {"law": "none", "semiring": "sum"}})");
    QCOMPARE(run({"statistic", "--frames", "one.npy", "--model", "sum.json", "--out", "sumL.npy"}).code, 0);
    QCOMPARE(readNumPy(pathOf("sumL.npy")).values, (std::vector<float>{0.5f, 3.5f, 4.5f}));
}

void tst_cliStatistic::mistakesInFrames_data()
{
    QTest::addColumn<QByteArray>("model");
    QTest::addColumn<QString>("message");
    QTest::newRow("other cells") << QByteArray(R"({"axes": [{"cells": 3}], "likelihood": {"kind": "linear"}})")
                                 << "do not match the frames of two.npy";
    QTest::newRow("other axes") << QByteArray(
        R"({"axes": [{"cells": 1}, {"cells": 2}], "likelihood": {"kind": "linear"}})")
                                << "do not match the frames of two.npy";
    QTest::newRow("misspelt key") << QByteArray(R"({"axis": []})") << "m.json.axis: unknown";
    QTest::newRow("no law") << QByteArray(
        R"({"axes": [{"cells": 2, "rateChange": [0.9]}], "likelihood": {"kind": "linear"}})")
                            << "axes[0].rateChange: h(0)";
    QTest::newRow("r0 of 0") << QByteArray(R"({"axes": [{"cells": 2}], "likelihood": {"kind": "rice", "r0": 0}})")
                             << "m.json: likelihood.r0 = 0: must be";
}

void tst_cliStatistic::mistakesInFrames()
{
    QFETCH(QByteArray, model);
    QFETCH(QString, message);
    writeArray(pathOf("two.npy"), {3, 2}, {1, 2, 3, 4, 5, 6});
    writeBytes(pathOf("m.json"), model);
    const Outcome told = run({"statistic", "--frames", "two.npy", "--model", "m.json", "--out", "x.npy"});
    QCOMPARE(told.code, 2);
    QVERIFY2(told.err.startsWith("error: m.json") && told.err.count('\n') == 1, told.err.data());
    QVERIFY2(QString::fromUtf8(told.err).contains(message), told.err.data());
    QVERIFY(!QFile::exists(path("x.npy")));
}

FAINTLINE_TEST(tst_cliStatistic)
#include "tst_cliStatistic.moc"
