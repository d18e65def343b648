#include "app/cli/CommandLineTest.h"

#include <QtTest>

using namespace faintline;
using namespace faintline::test;

/// replay: what the program wrote is made again from what stands beside it, and compared.
class tst_cliReplay : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    void resultsAreMadeAgain();
};

void tst_cliReplay::resultsAreMadeAgain()
{
    QCOMPARE(run(QStringList{"detect", "line.wav", "--events", "again.csv", "--statistic=again.npy"} + lineSettings).code, 0);
    Outcome replayed = run({"replay", "again.csv"});
    QCOMPARE(replayed.err, QByteArray());
    QCOMPARE(replayed.out, QByteArray("again.csv: the same bytes\nagain.npy: the same bytes\n"));
    QCOMPARE(replayed.code, 0);

    // What was changed by hand is told from what was made.
    QByteArray changed = content("again.csv");
    changed[changed.size() - 2] = changed[changed.size() - 2] == '1' ? '2' : '1';
    writeBytes(pathOf("again.csv"), changed);
    replayed = run({"replay", "again.csv.provenance.json"});
    QCOMPARE(replayed.code, 1);
    QVERIFY2(replayed.err.contains("again.csv"), replayed.err.constData());

    // What somebody judged elsewhere stands beside the events.
    QCOMPARE(run(QStringList{"detect", "line.wav", "--events", "plain.csv"} + lineSettings).code, 0);
    QVERIFY(!content("plain.csv").contains("review"));
    writeBytes(pathOf("judged.txt"), "8\t22\t[rejected] mains\n\\\t205\t218\n");
    QCOMPARE(run(QStringList{"detect", "line.wav", "--annotations", "judged.txt", "--events", "judged.csv"} + lineSettings).err,
             QByteArray());
    QVERIFY2(content("judged.csv").contains("rejected") && content("judged.csv").contains("mains"), content("judged.csv").constData());
    QCOMPARE(run({"replay", "judged.csv"}).out, QByteArray("judged.csv: the same bytes\n"));
    QCOMPARE(run(QStringList{"detect", "line.wav", "--annotations", "judged.txt", "--summary"} + lineSettings).code, 2);
    const Outcome missing = run(QStringList{"detect", "line.wav", "--annotations", "none.txt", "--events", "e.csv"} + lineSettings);
    QCOMPARE(missing.code, 2);
    QCOMPARE(missing.err.count('\n'), 1);

    // So is an input that is another one by now, and a file of which nothing is known.
    QCOMPARE(run({"simulate", "scene.json", "--out", "input.wav", "--seed", "5"}).code, 0);
    QCOMPARE(run(QStringList{"detect", "input.wav", "--events", "input.csv"} + lineSettings).code, 0);
    QCOMPARE(run({"simulate", "scene.json", "--out", "input.wav", "--seed", "6"}).code, 0);
    replayed = run({"replay", "input.csv"});
    QCOMPARE(replayed.code, 2);
    QVERIFY2(replayed.err.contains("input.wav"), replayed.err.constData());
    QCOMPARE(run({"replay", "scene.json"}).code, 2);

    // A provenance that somebody made up runs nothing.
    const std::string head = R"({"faintline": "0", "folder": ".", "inputs": [], )";
    for (const char *tail :
         {R"("arguments": ["replay", "made.up"], "outputs": ["made.up"]})", R"("arguments": ["detect"], "outputs": []})",
          R"("arguments": ["detect", "line.wav", "--summary"], "outputs": ["made.up"]})", R"("arguments": 7, "outputs": []})"}) {
        writeBytes(pathOf("made.up.provenance.json"), QByteArray::fromStdString(head + tail));
        replayed = run({"replay", "made.up"});
        QCOMPARE(replayed.code, 2);
        QVERIFY2(replayed.err.contains("made.up.provenance.json"), replayed.err.constData());
        QCOMPARE(replayed.out.count('\n') <= 1, true);
    }
}

QTEST_GUILESS_MAIN(tst_cliReplay)
#include "tst_cliReplay.moc"
