#include "app/cli/CommandLineTest.h"
#include "support/test.h"

#include <sys/resource.h>

using namespace faintline;
using namespace faintline::test;

/// Memory does not grow with the age of a track: one steady line for a day.
class tst_cliLongLine : public CommandLineTest
{
    Q_OBJECT

private slots:
    void aDayOfOneLine_data()
    {
        QTest::addColumn<QString>("window");
        QTest::newRow("windows of 4 s") << "4";
        QTest::newRow("windows of 0.5 s") << "0.5";
    }

    // 24 hours at 100 Hz. Checkpoints that each held a level for every frame since detection took 283 MiB for 4 hours,
    // and 3690 in the narrower window.
    void aDayOfOneLine()
    {
        QFETCH(QString, window);
        if (!QFile::exists(path("day.wav"))) {
            writeBytes(pathOf("day.json"),
                       R"({"kind": "lines", "sampleRateHz": 100, "durationSeconds": 86400, "seed": 5,
            "lines": [{"snrDb": 12, "referenceSeconds": 1, "startSeconds": 60, "frequencyHz": 21}]})");
            QCOMPARE(run({"simulate", "day.json", "--out", "day.wav"}).code, 0);
        }
        const Outcome found = run({"detect", "day.wav", "--set", "spectrogram.windowSeconds=" + window, "--set",
                                   "decide.falseAlarmsPerHour=0.01", "--events", "e.csv", "--threads", "1"});
        QCOMPARE(found.err, QByteArray());
        QCOMPARE(found.code, 0);
        const auto rows = numbersOf(content("e.csv"));
        QVERIFY(!rows.empty());
        QVERIFY(content("e.csv").contains("t_onset"));
        if (isSanitized) // which keeps books of its own
            return;
        rusage largest = {};
        getrusage(RUSAGE_CHILDREN, &largest);
        QVERIFY2(largest.ru_maxrss <= 100 * 1024, qPrintable(QString::number(largest.ru_maxrss) + " kB"));
    }
};

FAINTLINE_TEST(tst_cliLongLine)
#include "tst_cliLongLine.moc"
