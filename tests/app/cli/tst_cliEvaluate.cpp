#include "app/cli/CommandLineTest.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// evaluate: the charts it writes beside its curve, and the theory on them.
class tst_cliEvaluate : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase();
    void chartsHaveTheory();
    void theRocIsOfTheSnrThatIsAsked();
    void theRocIsWrittenAsNumbers();
    void resultsAreReplayed();
    void shardsAreDrawnTogether();
    void mistakes_data();
    void mistakes();
};

void tst_cliEvaluate::initTestCase()
{
    QVERIFY2(QFile::exists(program), "faintline-cli is not built");
    // A line of constant frequency and amplitude, an integrator of its duration and no taper: Marcum's Q holds.
    writeBytes(
        pathOf("experiment.json"),
        R"({"kind": "lines", "runs": 8, "frames": 300, "blockFrames": 100, "blockBins": 60, "durationWindows": 20,
                   "stepsPerWindow": 1, "binsPerCell": 1, "window": "rectangular", "snrDb": [-3, 0, 3],
                   "detectors": [{"name": "sum of 20",
                                  "settings": {"detector.kind": "integrator", "integrator.durationWindows": 20}}]})");
}

void tst_cliEvaluate::chartsHaveTheory()
{
    const Outcome done =
        run({"evaluate", "experiment.json", "--out", "curve.csv", "--chart", "pd.svg", "--roc", "roc.svg"});
    QCOMPARE(done.err, QByteArray());
    QCOMPARE(done.code, 0);
    for (const QString name : {"pd.svg", "roc.svg"}) {
        const QByteArray svg = content(name);
        QVERIFY2(svg.startsWith("<svg") && svg.contains("sum of 20"), qPrintable(name));
        QVERIFY2(svg.contains("sum of 20, Marcum Q"), qPrintable(name));
    }
    QVERIFY(content("roc.svg").contains("False alarms per block"));
    QVERIFY(content("roc.svg").contains("at 0 dB"));
    QVERIFY(!content("pd.svg").contains("False alarms per block"));
}

void tst_cliEvaluate::theRocIsOfTheSnrThatIsAsked()
{
    const auto roc = [&](const QString &name, const QStringList &options) {
        const Outcome done = run(QStringList{"evaluate", "experiment.json", "--roc", name} + options);
        return done.err.isEmpty() && done.code == 0 ? content(name) : QByteArray();
    };
    const QByteArray usual = roc("usual.svg", {});
    QVERIFY(!usual.isEmpty());
    QCOMPARE(roc("0.svg", {"--roc-snr", "0"}), usual);
    QVERIFY(roc("3.svg", {"--roc-snr", "3"}) != usual);
    QVERIFY(content("3.svg").startsWith("<svg"));
}

void tst_cliEvaluate::theRocIsWrittenAsNumbers()
{
    const Outcome done = run({"evaluate", "experiment.json", "--out", "both.csv", "--roc", "roc.csv"});
    QCOMPARE(done.err, QByteArray());
    QCOMPARE(done.code, 0);
    const QList<QByteArray> lines = content("roc.csv").trimmed().split('\n');
    QCOMPARE(lines.front(), QByteArray("detector,snr_db,threshold,false_alarms_per_block,pd,pd_low,pd_high"));
    QVERIFY(lines.size() > 10);
    double threshold = 1e9;
    double falseAlarms = -1.0;
    for (const QByteArray &line : lines.mid(1)) {
        const QList<QByteArray> cells = line.split(',');
        QCOMPARE(cells.size(), 7);
        QCOMPARE(cells[1], QByteArray("0")); // the middle SNR
        QVERIFY(cells[2].toDouble() < threshold && cells[3].toDouble() > falseAlarms);
        QVERIFY(cells[5].toDouble() <= cells[4].toDouble() && cells[4].toDouble() <= cells[6].toDouble());
        threshold = cells[2].toDouble();
        falseAlarms = cells[3].toDouble();
    }
    // The curve's threshold is that of one false alarm per block.
    for (const QByteArray &line : content("both.csv").trimmed().split('\n').mid(1)) {
        const QByteArray own = line.split(',').back();
        const auto there = std::ranges::find_if(lines, [&](const QByteArray &row) { return row.split(',')[2] == own; });
        QVERIFY2(there != lines.end(), line.data());
        QVERIFY(std::abs(there->split(',')[3].toDouble() - 1.0) < 0.2); // of 24 blocks' maxima
    }
}

void tst_cliEvaluate::resultsAreReplayed()
{
    QCOMPARE(run({"evaluate", "experiment.json", "--out", "kept.csv", "--roc", "kept.svg"}).code, 0);
    for (const QString name : {"kept.csv", "kept.svg"}) {
        QVERIFY(QFile::exists(path(name + ".provenance.json")));
        const Outcome same = run({"replay", name});
        QCOMPARE(same.err, QByteArray());
        QCOMPARE(same.code, 0);
    }
    writeBytes(pathOf("kept.csv"), content("kept.csv") + "\n");
    QCOMPARE(run({"replay", "kept.csv"}).code, 1);
}

void tst_cliEvaluate::shardsAreDrawnTogether()
{
    for (const QString shard : {"1", "2"}) {
        const Outcome done =
            run({"evaluate", "experiment.json", "--shard", shard + "/2", "--out", "shard" + shard + ".json"});
        QCOMPARE(done.err, QByteArray());
    }
    QCOMPARE(run({"evaluate", "merge", "shard1.json", "shard2.json", "--out", "merged.csv", "--roc", "merged.svg"}).err,
             QByteArray());
    QCOMPARE(run({"evaluate", "experiment.json", "--roc", "whole.svg"}).err, QByteArray());
    QVERIFY(content("whole.svg").startsWith("<svg"));
    QCOMPARE(content("merged.svg"), content("whole.svg"));
}

void tst_cliEvaluate::mistakes_data()
{
    QTest::addColumn<QStringList>("options");
    QTest::addColumn<QByteArray>("says");
    QTest::newRow("SNR") << QStringList{"--roc", "r.svg", "--roc-snr", "1"} << QByteArray("-3, 0, 3");
    QTest::newRow("SNR of no ROC") << QStringList{"--roc-snr", "0"} << QByteArray("requires --roc");
    QTest::newRow("format") << QStringList{"--roc", "r.png"} << QByteArray(".svg");
    QTest::newRow("one file twice") << QStringList{"--roc", "r.svg", "--chart", "r.svg"} << QByteArray("r.svg");
}

void tst_cliEvaluate::mistakes()
{
    QFETCH(QStringList, options);
    QFETCH(QByteArray, says);
    const Outcome done = run(QStringList{"evaluate", "experiment.json"} + options);
    QVERIFY(done.code != 0);
    QCOMPARE(done.err.count('\n'), 1);
    QVERIFY2(done.err.contains(says), done.err.constData());
    QVERIFY(QDir(folder()).entryList({"r.*"}).isEmpty());
}

FAINTLINE_TEST(tst_cliEvaluate)
#include "tst_cliEvaluate.moc"
