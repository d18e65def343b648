#include "app/cli/CommandLineTest.h"
#include "support/test.h"

#include <sys/resource.h>

using namespace faintline;
using namespace faintline::test;

/// Memory and time are bounded by a file's size: none below 1 MB takes more than 256 MB or 10 s to be read, or to be
/// refused in one line.
class tst_cliBounded : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    void smallFiles_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QByteArray>("text");
        const QStringList annotated{"detect", "line.wav", "--events", "o.csv", "--annotations", "@"};
        QTest::newRow("table of wide empty rows, CSV")
            << annotated << "event,t_onset,t_end" + QByteArray(250000, ',') + QByteArray(600000, '\n') + "a";
        QTest::newRow("table of wide empty rows, Raven")
            << annotated << "Begin Time (s)\tEnd Time (s)" + QByteArray(250000, '\t') + QByteArray(600000, '\n') + "a";
        QTest::newRow("labels of many cells") << annotated << (QByteArray(1000, '\t') + "\n").repeated(900) + "a";

        const QStringList info{"info", "@.json"};
        const QByteArray lines = R"({"sampleRateHz": 1000, "durationSeconds": 100000, "lines": [)";
        const QByteArray wandering =
            R"({"frequencyHz": 100, "wanderHz": 1, "wanderSeconds": 0.2, "fading": "rayleigh", "fadingSeconds": 1.5})";
        QTest::newRow("lines that wander fast") << info << lines + list(wandering, 3) + "]}";
        QTest::newRow("a line that wanders as fast as any")
            << info << lines + R"({"frequencyHz": 100, "wanderHz": 1, "wanderSeconds": 0.17}]})";
        QTest::newRow("many lines") << info << lines + list("{}", 300000) + "]}";
        const QByteArray pings = R"({"kind": "pings", "pings": 1000000, "targets": [)";
        QTest::newRow("many targets") << info << pings + list(R"({"rangeMetres": 5000})", 900) + "]}";
        QTest::newRow("as many targets as may be") << info << pings + list(R"({"rangeMetres": 5000})", 3) + "]}";
        QTest::newRow("many legs") << info
                                   << pings + R"({"rangeMetres": 5000, "legs": [)" + list(R"({"pings": 1})", 50000)
                                          + "]}]}";

        QByteArray keys;
        for (int i = 0; i < 80000; ++i)
            keys += (i ? ",\"" : "\"") + QByteArray::number(i) + "\": 1";
        QTest::newRow("an object of many keys")
            << QStringList{"info", "@.sigmf-meta"} << R"({"global": {)" + keys + "}}";
        QTest::newRow("a list of many objects")
            << QStringList{"info", "@.sigmf-meta"} << R"({"x": [)" + list("{}", 330000) + "]}";
        QTest::newRow("a session of many lists")
            << QStringList{"detect", "line.wav", "--summary", "--session", "@"} << "[" + list("[]", 330000) + "]";

        const QStringList statistic{"statistic", "--frames", "frames.npy", "--model", "@", "--out", "o.npy"};
        const QByteArray model = R"(], "likelihood": {"kind": "linear"}})";
        const QByteArray wide = R"({"cells": 1000000, "step": {"gaussian": 100000}})";
        QTest::newRow("a model of many axes") << statistic << R"({"axes": [)" + list(wide, 20000) + model;
        QTest::newRow("a model of as many axes as may be") << statistic << R"({"axes": [)" + list(wide, 8) + model;
        QTest::newRow("frames that are not there")
            << QStringList{"detect", "--frames", "@", "--summary"}
            << "\x93NUMPY\x01" + QByteArray(1, '\0') + "\x76" + QByteArray(1, '\0')
                   + QByteArray("{'descr': '<f8', 'fortran_order': False, 'shape': (2000000, 1000), }")
                         .leftJustified(0x76);
        QTest::newRow("a provenance of many added lines") << QStringList{"replay", "@"} << QByteArray();
        QTest::newRow("a provenance of many words") << QStringList{"replay", "@"} << QByteArray();
        QTest::newRow("a provenance of many options") << QStringList{"replay", "@"} << QByteArray();
    }

    void smallFiles()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QByteArray, text);
        QVERIFY(text.size() < 1'000'000);
        writeArray(pathOf("frames.npy"), {3, 4}, std::vector<float>(12, 1.0f));
        if (arguments.contains("replay"))
            writeBytes(pathOf("small.provenance.json"), provenance(QTest::currentDataTag()));
        arguments.replaceInStrings("@", "small");
        const QString name = arguments.filter("small").constFirst();
        writeBytes(path(name).toStdString(), text);

        const double before = processorSeconds();
        const Outcome outcome = run(arguments + lineSettings.mid(0, arguments.contains("line.wav") ? 4 : 0), [] {
            constexpr rlim_t seconds = 20 * slowdown; // ends what would not
            const rlimit most{seconds, seconds};
            setrlimit(RLIMIT_CPU, &most);
        });
        QVERIFY2(outcome.code == 0 || outcome.code == 2, outcome.err.left(2000).constData()); // 1 is a lack of memory
        QVERIFY(outcome.err.count('\n') == (outcome.code == 0 ? 0 : 1));
        if (isSanitized) // which keeps books of its own
            return;
        const double seconds = processorSeconds() - before; // whatever else the machine has to do
        QVERIFY2(seconds < 10.0, qPrintable(QString::number(seconds) + " s"));
        rusage largest = {};
        getrusage(RUSAGE_CHILDREN, &largest); // of all so far: the first above the bound is the one that broke it
        QVERIFY2(largest.ru_maxrss < 256 * 1024, qPrintable(QString::number(largest.ru_maxrss) + " kB"));
    }

private:
    /// Of all programs run so far.
    static double processorSeconds()
    {
        rusage used = {};
        getrusage(RUSAGE_CHILDREN, &used);
        const auto seconds = [](const timeval &time) { return double(time.tv_sec) + 1e-6 * double(time.tv_usec); };
        return seconds(used.ru_utime) + seconds(used.ru_stime);
    }

    static QByteArray list(const QByteArray &member, int count) { return (member + ",").repeated(count - 1) + member; }

    static QByteArray provenance(const QByteArray &kind)
    {
        if (kind.contains("added"))
            return R"({"version": "0", "settings": {}, "recording": {"scenario": {"kind": "lines", "sampleRateHz": 1000,
                  "durationSeconds": 2},
            "injected": [)"
                   + list(R"({"line": {"frequencyHz": 10}, "amplitude": 0.1})", 15000) + "]}}";
        return R"({"faintline": "0", "folder": ".", "inputs": [], "arguments": [)"
               + (kind.contains("options") ? list("\"--a\"", 110000) : "\"detect\", " + list("\"small\"", 40000))
               + R"(], "outputs": [)" + list("\"small\"", 40000) + "]}";
    }
};

FAINTLINE_TEST(tst_cliBounded)
#include "tst_cliBounded.moc"
