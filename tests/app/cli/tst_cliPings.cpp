#include "app/cli/CommandLineTest.h"
#include "base/json.h"
#include "support/test.h"

#include <cmath>

using namespace faintline;
using namespace faintline::test;

namespace {

/// The exponential frames of a stack as int16 magnitudes in reverberation that falls by 40 dB, with beams that differ.
QByteArray magnitudesOf(const NumPyArray &stack)
{
    const Index beams = stack.shape[2];
    QByteArray header =
        "{'descr': '<i2', 'fortran_order': False, 'shape': (" + QByteArray::number(qlonglong(stack.shape[0])) + ", "
        + QByteArray::number(qlonglong(stack.shape[1])) + ", " + QByteArray::number(qlonglong(beams)) + "), }";
    header = header.leftJustified(128 - 10 - 1, ' ') + '\n';
    QByteArray bytes = QByteArray("\x93NUMPY\x01\x00", 8) + char(header.size()) + '\0' + header;
    for (std::size_t i = 0; i < stack.values.size(); ++i) {
        const Index cell = Index(i) % (stack.shape[1] * beams);
        const double mean =
            std::pow(10.0, 6.0 - 4.0 * double(cell / beams) / double(stack.shape[1]) + 0.1 * double(cell % beams));
        const auto value = std::int16_t(std::lround(std::min(32767.0, std::sqrt(mean * double(stack.values[i])))));
        bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
    }
    return bytes;
}

const QStringList settings{"--preset", "sonar", "--set", "decide.thresholdNats=20"};

} // namespace

/// Recorded pings from outside: what is assumed of them is told, and targets are found as in normalised frames.
class tst_cliPings : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        writeBytes(
            pathOf("pings.json"),
            R"({"kind": "pings", "pings": 48, "rangeCells": 90, "beams": 8, "targets": [{"snrDb": 12, "rangeMetres": 3200,
        "bearingDegrees": 315, "appearPing": 4, "legs": [{"rangeCellsPerPing": 1, "beamsPerPing": 0.1}]}]})");
        QCOMPARE(run({"simulate", "pings.json", "--out", "P.npy", "--truth", "P.truth.json"}).code, 0);
        writeBytes(pathOf("raw.npy"), magnitudesOf(readNumPy(pathOf("P.npy"))));
        m_grid = content("P.grid.json");
        writeBytes(pathOf("raw.grid.json"), m_grid);
        writeBytes(pathOf("raw.truth.json"), content("P.truth.json"));
    }

    void infoTellsTheGuess()
    {
        const Outcome told = run({"info", "raw.npy"});
        QCOMPARE(told.err, QByteArray());
        QVERIFY2(told.out.contains("container     NumPy pings, int16\n")
                     && told.out.contains("pings         48, one every 40 s\n")
                     && told.out.contains("range         90 cells of 10 m, 3000 … 3890 m\n")
                     && told.out.contains("values        magnitude (guessed; the grid file or pings.values can say)\n"),
                 told.out.data());
        const Json json = parseJson(run({"info", "raw.npy", "--json"}).out.toStdString(), "info");
        QCOMPARE(json["sampleType"], Json("int16"));
        QCOMPARE(json["axes"].size(), std::size_t(2));
        QVERIFY(run({"info", "P.npy"}).out.contains("values        normalised"));
    }

    void theTargetIsFound()
    {
        const Outcome found = run(QStringList{"detect", "raw.npy", "--summary"} + settings);
        QCOMPARE(found.code, 0);
        QVERIFY2(found.out.contains("target 1: detected in its ping"), found.out.data());
        QVERIFY2(found.err.startsWith("note: raw.npy: int16, taken as magnitude from its distribution;")
                     && found.err.count('\n') == 1,
                 found.err.data());
        const Outcome lines = run(QStringList{"detect", "raw.npy", "--summary", "--progress", "json"} + settings);
        QVERIFY2(lines.err.contains("{\"note\":\"raw.npy: int16, taken as magnitude"), lines.err.data());
        // The latency is that of frames divided by their true noise, within two pings.
        const auto latency = [&](const QByteArray &summary) {
            const QByteArray words = "target 1: detected in its ping ";
            return summary.mid(summary.indexOf(words) + words.size()).split(',').front().toInt();
        };
        const Outcome known = run(QStringList{"detect", "P.npy", "--summary"} + settings);
        QCOMPARE(known.err, QByteArray());
        QVERIFY(std::abs(latency(found.out) - latency(known.out)) <= 2);
    }

    void whatIsStatedIsNotTold()
    {
        QCOMPARE(run(QStringList{"detect", "raw.npy", "--events", "guessed.csv"} + settings).code, 0);
        const Outcome set =
            run(QStringList{"detect", "raw.npy", "--events", "set.csv", "--set", "pings.values=magnitude"} + settings);
        QCOMPARE(set.err, QByteArray());
        QCOMPARE(content("set.csv"), content("guessed.csv"));
        QByteArray stated = m_grid;
        stated.insert(stated.lastIndexOf('}'), R"(, "values": "magnitude")");
        writeBytes(pathOf("stated.json"), stated);
        const Outcome given = run(
            QStringList{"detect", "--frames", "raw.npy", "--grid", "stated.json", "--events", "given.csv"} + settings);
        QCOMPARE(given.err, QByteArray());
        QCOMPARE(content("given.csv"), content("guessed.csv"));
    }

    void statisticTakesThem()
    {
        writeBytes(pathOf("model.json"),
                   R"({"axes": [{"cells": 90, "rates": [-1, 0, 1], "rateChange": [0.8, 0.1]}, {"cells": 8}],
                   "likelihood": {"kind": "linear"}, "reset": {"law": "fixed", "lnK": -1}})");
        const Outcome made = run({"statistic", "--frames", "raw.npy", "--model", "model.json", "--out", "L.npy",
                                  "--projected", "D.npy", "--set", "pings.values=magnitude"});
        QCOMPARE(made.err, QByteArray());
        QCOMPARE(readNumPy(pathOf("D.npy")).shape, (std::vector<Index>{48, 90, 8}));
        const Outcome wrong = run({"statistic", "--frames", "raw.npy", "--model", "model.json", "--out", "L.npy",
                                   "--set", "noise.causal=true"});
        QCOMPARE(wrong.code, 2);
        QVERIFY2(wrong.err.contains("must be a setting of pings"), wrong.err.data());
    }

    void mistakes()
    {
        const Outcome wrong = run({"detect", "raw.npy", "--set", "pings.values=normalised"});
        QCOMPARE(wrong.code, 2);
        QVERIFY2(wrong.err.contains("holds int16, which cannot be taken as normalised"), wrong.err.data());
        const Outcome unknown = run({"detect", "raw.npy", "--set", "pings.values=loud"});
        QCOMPARE(unknown.code, 2);
        QVERIFY2(unknown.err.contains("must be one of auto, normalised, power, magnitude, decibels"),
                 unknown.err.data());
    }

private:
    QByteArray m_grid; ///< without values
};

FAINTLINE_TEST(tst_cliPings)
#include "tst_cliPings.moc"
