#include "app/cli/CommandLineTest.h"
#include "support/test.h"

#include <csignal>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

using namespace faintline;
using namespace faintline::test;

/// Standard streams that are full or closed, signals that ask to stop, and names and texts that a terminal or JSON
/// would choke on.
class tst_cliStreams : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    void outputThatCannotBeWritten_data();
    void outputThatCannotBeWritten();
    void closedStreamsTakeNothing();
    void stopsWhenAsked_data();
    void stopsWhenAsked();
    void controlCharactersStayOut_data();
    void controlCharactersStayOut();
    void namesThatAreNoText();
};

void tst_cliStreams::outputThatCannotBeWritten_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("info") << QStringList{"info", "line.wav"};
    QTest::newRow("describe") << QStringList{"describe"};
    QTest::newRow("summary") << QStringList{"detect", "line.wav", "--summary"} + lineSettings;
    QTest::newRow("explanation") << QStringList{"explain", "line.wav", "--time", "15", "--frequency", "210"}
                                        + lineSettings;
    QTest::newRow("comparison") << QStringList{"compare", "line.wav", "--set-b", "model.snr=5"} + lineSettings;
    QTest::newRow("calibration") << QStringList{"calibrate", "line.wav"} + lineSettings;
    QTest::newRow("help") << QStringList{"--help"};
    QTest::newRow("version") << QStringList{"--version"};
}

void tst_cliStreams::outputThatCannotBeWritten()
{
    QFETCH(QStringList, arguments);
    for (const bool isClosed : {false, true}) {
        const Outcome told = run(arguments, [isClosed] {
            if (isClosed)
                ::close(STDOUT_FILENO);
            else
                ::dup2(::open("/dev/full", O_WRONLY), STDOUT_FILENO);
        });
        QCOMPARE(told.code, 1);
        QCOMPARE(told.err, QByteArray("error: standard output: cannot be written; the output is incomplete\n"));
    }
    QCOMPARE(run({"simulate", "scene.json", "--out", "silent.wav"}, [] { ::close(STDOUT_FILENO); }).code,
             0); // has nothing to say
}

void tst_cliStreams::closedStreamsTakeNothing()
{
    QCOMPARE(run({"simulate", "scene.json", "--out", "open.wav", "--progress", "json"}).code, 0);
    for (const std::vector<int> &closed :
         {std::vector{STDERR_FILENO}, std::vector{STDOUT_FILENO, STDERR_FILENO}, std::vector{0, 1, 2}}) {
        const Outcome told = run({"simulate", "scene.json", "--out", "closed.wav", "--progress", "json"}, [&] {
            for (const int descriptor : closed)
                ::close(descriptor);
        });
        QCOMPARE(told.code, 0);
        QVERIFY(content("closed.wav") == content("open.wav")); // and no progress
    }
}

void tst_cliStreams::stopsWhenAsked_data()
{
    QTest::addColumn<QStringList>("arguments");
    const QStringList law{"--set", "model.snr=0.7"}; // whose calibration is not shipped, and takes seconds
    QTest::newRow("large pings") << QStringList{"simulate", "pings.json", "--out", "o.npy"};
    QTest::newRow("an experiment's many SNRs") << QStringList{"evaluate", "experiment.json", "--out", "o.csv"};
    QTest::newRow("calibration") << QStringList{"calibrate", "--set", "spectrogram.windowSeconds=0.7"} + law;
    QTest::newRow("a window that is chosen")
        << QStringList{"detect", "line.wav", "--events", "o.csv", "--statistic", "o.npy"} + law;
    QTest::newRow("a window that is chosen, to explain")
        << QStringList{"explain", "line.wav", "--time", "15", "--frequency", "210"} + law;
    QTest::newRow("windows that are chosen, to compare")
        << QStringList{"compare", "line.wav", "--set-b", "model.snr=5", "--events", "o.csv"};
    QTest::newRow("a window that is chosen, to calibrate")
        << QStringList{"calibrate", "line.wav", "--surrogates", "5"} + law;
    QTest::newRow("a pipe for frames") << QStringList{"detect", "--frames", "pipe", "--tracks", "o.csv"};
    QTest::newRow("a pipe for a statistic")
        << QStringList{"statistic", "--frames", "pipe", "--model", "model.json", "--out", "o.npy"};
    QTest::newRow("a pipe for shards") << QStringList{"merge", "pipe", "--out", "o.csv"};
    QTest::newRow("a pipe for annotations")
        << QStringList{"detect", "line.wav", "--annotations", "pipe", "--events", "o.csv"};
}

void tst_cliStreams::stopsWhenAsked()
{
    QFETCH(QStringList, arguments);
    writeBytes(pathOf("pings.json"),
               R"({"kind": "pings", "pings": 100, "rangeCells": 100000, "beams": 100, "looks": 100})");
    QByteArray snrs = "1";
    for (int i = 2; i <= 100000; ++i)
        snrs += "," + QByteArray::number(i * 1e-4);
    writeBytes(pathOf("experiment.json"),
               R"({"kind": "lines", "runs": 2, "frames": 60, "blockFrames": 30, "blockBins": 30,
        "durationWindows": 10, "snrDb": [)"
                   + snrs + R"(], "detectors": [{"name": "P", "settings": {"detector.kind": "pOfN"}}]})");
    ::mkfifo(pathOf("pipe").c_str(), 0600);
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("FAINTLINE_CACHE", "off");
    process.setProcessEnvironment(environment);
    process.setWorkingDirectory(folder());
    process.start(program, arguments);
    QVERIFY(process.waitForStarted());
    if (process.waitForFinished(700))
        QFAIL(("was done already: " + process.readAllStandardError()).constData());
    QElapsedTimer timer;
    timer.start();
    ::kill(static_cast<pid_t>(process.processId()), arguments.front() == "evaluate" ? SIGINT : SIGTERM);
    QVERIFY(process.waitForFinished(10'000 * slowdown));
    qInfo("%lld ms", static_cast<long long>(timer.elapsed()));
    QVERIFY(timer.elapsed() < 2000 * slowdown); // half a second of patience, and a machine that is busy
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 1);
    QCOMPARE(process.readAllStandardError(), QByteArray("error: interrupted: no incomplete output was left\n"));
    QCOMPARE(QDir(folder()).entryList({"o.*-*.part", "o.npy"}), QStringList());
}

void tst_cliStreams::controlCharactersStayOut_data()
{
    QTest::addColumn<QByteArray>("evil");
    QTest::newRow("escape") << QByteArray("\x1b[31m");
    QTest::newRow("C1") << QByteArray("\xc2\x9b"
                                      "31m");
    QTest::newRow("override") << QByteArray("\xe2\x80\xae"
                                            "vaw.exe");
    QTest::newRow("isolate") << QByteArray("\xe2\x81\xa6x");
    QTest::newRow("mark") << QByteArray("\xd8\x9c");
}

void tst_cliStreams::controlCharactersStayOut()
{
    QFETCH(QByteArray, evil);
    const QByteArray inJson = evil.startsWith('\x1b') ? "\\u001b" + evil.mid(1) : evil;
    writeBytes(pathOf("e.sigmf-data"), QByteArray(400, '\0'));
    writeBytes(pathOf("e.sigmf-meta"), R"({"global": {"core:datatype": "rf32_le", "core:sample_rate": 50},
        "captures": [{"core:sample_start": 0, "core:datetime": ")"
                                           + inJson + "\"}]}");
    writeArray(pathOf("frames.npy"), {60, 40}, std::vector<float>(2400, 1.0f));
    writeBytes(pathOf("grid.json"), R"({"axes": [{"name": ")" + inJson + R"(", "unit": ")" + inJson + R"("}]})");
    writeBytes(pathOf("names.json"),
               R"({"kind": "lines", "runs": 1, "frames": 60, "blockFrames": 30, "blockBins": 30, "durationWindows": 10,
        "snrDb": [3], "detectors": [{"name": ")"
                   + inJson + R"(", "settings": {"detector.kind": "pOfN"}}]})");
    const QByteArray name = "name" + evil + ".wav";
    writeBytes(folder().toStdString() + "/" + name.toStdString(), content("line.wav"));
    for (const QStringList &arguments :
         {QStringList{"info", "e.sigmf-meta"},
          {"info", "e.sigmf-meta", "--json"},
          {"info", QString::fromUtf8(name)},
          {"info", QString::fromUtf8(name), "--json"},
          {"info", QString::fromUtf8("none" + evil)},
          {"evaluate", "names.json"},
          {"explain", "frames.npy", "--grid", "grid.json", "--time", "30", "--frequency", "20"}}) {
        const Outcome told = run(arguments);
        QVERIFY2(told.code == 0 || arguments[1].startsWith("none"), told.err.constData());
        QVERIFY2(!(told.out + told.err).contains(evil), qPrintable(arguments.join(' ')));
    }
}

void tst_cliStreams::namesThatAreNoText()
{
    // Qt has no such names; a shell has.
    const auto shell = [&](const QByteArray &line) {
        QProcess process;
        process.setWorkingDirectory(folder());
        process.start("/bin/sh",
                      {"-c", "set -e; n=$(printf 'n\\377\\342'); cli=\"" + program + "\"; " + QString::fromUtf8(line)});
        process.waitForFinished(patience);
        return Outcome{process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
    };
    const QByteArray detection = "\"$cli\" detect $n.wav --events $n.csv " + lineSettings.join(' ').toUtf8();
    QCOMPARE(shell("\"$cli\" simulate scene.json --out $n.wav; " + detection).err, QByteArray());
    const Outcome replayed = shell("\"$cli\" replay $n.csv");
    QCOMPARE(replayed.err, QByteArray());
    QCOMPARE(replayed.out, QByteArray("n??.csv: the same bytes\n"));
    const Outcome info = shell("\"$cli\" info $n.wav --json");
    QCOMPARE(info.err, QByteArray());
    QVERIFY2(info.out.contains("n\\udbff\\udeff\\udbff\\udee2.wav"), info.out.constData());
    QVERIFY(shell("\"$cli\" info $n.wav").out.contains("n??.wav"));
    QCOMPARE(shell("\"$cli\" info no$n.wav").err, QByteArray("error: non??.wav: no such file\n"));
    shell("rm -f $n*"); // which Qt cannot
}

FAINTLINE_TEST(tst_cliStreams)
#include "tst_cliStreams.moc"
