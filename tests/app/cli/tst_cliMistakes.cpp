#include "app/cli/CommandLineTest.h"
#include "support/test.h"

#include <csignal>

#include <sys/resource.h>
#include <unistd.h>

using namespace faintline;
using namespace faintline::test;

/// What goes wrong is said in one line, and nothing half-written is left.
class tst_cliMistakes : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        simulateLine();
        QVERIFY(QFile::link("to.csv", path("linked.csv")));
    }

    void mistakes_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QString>("message");
        const auto row = [](const char *name, const QStringList &arguments, const char *message) {
            QTest::newRow(name) << arguments << QString::fromUtf8(message);
        };
        row("nothing asked", {}, "command line: A subcommand is required");
        row("no such command", {"dtect"},
            "dtect: unknown command; did you mean detect? (faintline-cli --help lists the commands)");
        row("no command like this", {"whistle"}, "whistle: unknown command; faintline-cli --help lists the commands");
        row("no such command after an option", {"--threads", "2", "dtect", "line.wav"}, "dtect: unknown command");
        row("no such option", {"detect", "line.wav", "--summery"},
            "command line: The following argument was not expected: --summery");
        row("no number", {"detect", "line.wav", "--summary", "--from", "soon"},
            "command line: Could not convert: --from = soon");
        row("no threads", {"--threads", "0", "describe"}, "command line: --threads");
        row("no such file", {"info", "none.wav"}, "none.wav: no such file");
        row("a folder", {"info", "."}, "./line.wav: has no time stamp");
        row("a text", {"info", "truth.json"}, "");
        row("unknown setting", {"describe", "smd.k"}, "smd.k: unknown setting; did you mean smd.lnK");
        row("misspelt setting", {"detect", "line.wav", "--summary", "--set", "smd.thresold=3"},
            "smd.thresold: unknown "
            "setting; did you mean ");
        row("signal too strong for any K", {"detect", "line.wav", "--summary", "--set", "model.snr=50"},
            "model.snr = 50: permits no ln K at which half of the states continue on noise: at 20 nat ");
        row("no assignment", {"detect", "line.wav", "--summary", "--set", "smd.lnK"},
            "--set smd.lnK: must be name=value");
        row("decimal comma in an option", {"detect", "line.wav", "--summary", "--from", "2,5"},
            "command line: Could not convert: --from = 2,5 has a decimal comma; write a decimal point");
        row("comparison without a recording", {"compare"}, "command line: FILE is required");
        row("comparison in another format", {"compare", "line.wav", "--events", "e.txt"},
            "e.txt: the file name must end in .csv");
        row("comparison with a misspelt setting", {"compare", "line.wav", "--set-b", "smd.thresold=3"},
            "smd.thresold: unknown setting");
        row("no input", {"detect", "--summary"}, "detect: needs a recording, or --frames");
        row("two inputs", {"detect", "line.wav", "--frames", "y.npy", "--summary"},
            "detect: accepts either a recording or "
            "--frames");
        row("two outputs that are one", {"detect", "line.wav", "--events", "z.csv", "--tracks", "./z.csv"},
            "./z.csv: is given for two outputs");
        row("statistic and events that are one",
            {"detect", "line.wav", "--events", "linked.csv", "--statistic", "to.csv"},
            "to.csv: is given for two outputs");
        row("recordings that are one", {"straighten", "line.wav", "--out", "z.wav", "--rest", "./z.wav"},
            "./z.wav: is given for two outputs");
        row("output that is another's provenance",
            {"detect", "line.wav", "--events", "e.csv", "--tracks", "e.csv.provenance.json"},
            "e.csv.provenance.json: is given for two outputs");
        row("live outputs that are one", {"listen", "line.wav", "--out", "z.json", "--events", "./z.json"},
            "./z.json: is given for two outputs");
        row("unknown kind of events", {"detect", "line.wav", "--events", "e.xml"}, "e.xml: the file name must end in");
        row("unknown kind of tracks", {"detect", "line.wav", "--tracks", "t.txt"}, "t.txt: the file name must end in");
        row("no such folder", {"detect", "line.wav", "--statistic", "no/D.npy"},
            "no/D.npy: cannot be written: No such file or directory");
        row("channel", {"detect", "line.wav", "--summary", "--channel", "1"},
            "selection.channel = 1: the recording has 1 channel(s)");
        row("one channel as I/Q", {"detect", "line.wav", "--summary", "--iq"},
            "line.wav: has 1 channel(s); I/Q needs an "
            "even number");
        row("behind the end", {"detect", "line.wav", "--summary", "--from", "31"},
            "selection.fromSeconds = 31: must lie before");
        row("band upside down", {"detect", "line.wav", "--summary", "--low", "50", "--high", "20"},
            "selection.lowHz = 50: must not lie above");
        row("least SNR that is no number", {"detect", "line.wav", "--hits", "h.dat", "--least-snr", "nan"},
            "--least-snr: must be a number from 0 to 1e+12");
        row("slack that is no number", {"cadence", "on.dat", "off.dat", "--slack", "nan"},
            "--slack: must be a number from 0 to 1e+09");
        row("time between reports that is no number", {"listen", "line.wav", "--update", "nan"},
            "--update: must be a number from 0.1 to 1e+06");
        row("tolerance that is no number", {"compare", "line.wav", "--frames", "nan"},
            "--frames: must be a number from 0 to 1e+06");
        row("latitude beyond the pole", {"survey", "export", "s.sqlite", "--latitude", "91"},
            "--latitude: must be a number from -90 to 90");
        row("rate of raw samples without an end", {"listen", "line.wav", "--raw-type", "cu8", "--raw-rate", "inf"},
            "--raw-rate: must be a number from 1e-09 to 1e+15");
        row("rate that no receiver has",
            {"listen", "--rtl-tcp", "localhost", "--frequency", "1e8", "--raw-rate", "5e9"},
            "both in Hz and below 2^32");
        row("event that is a word", {"doppler", "line.wav", "--event", "last"},
            "--event: must be a number from 1 to 1e+09");
        row("channel below 0", {"detect", "line.wav", "--summary", "--channel", "-1"},
            "--channel: must be a number from 0 to 1023");
        row("one of several channels that is not there",
            {"detect", "line.wav", "--summary", "--set", "selection.channels=5"},
            "selection.channels = 5: the recording has 1 channel(s), counted from 0");
        row("longer than the recording", {"detect", "line.wav", "--summary", "--set", "spectrogram.windowSeconds=31"},
            "shorter than one window of 31 s");
        row("unknown preset", {"detect", "line.wav", "--summary", "--preset", "x"},
            "preset x: unknown; choose one of lines, billon");
        row("no session", {"detect", "line.wav", "--summary", "--session", "line.wav"}, "line.wav: is not valid JSON");
        row("no scene", {"simulate", "line.wav", "--out", "x.wav"}, "line.wav: is not valid JSON");
        row("no kind of recording", {"simulate", "scene.json", "--out", "x.xyz"}, "x.xyz: has no known extension");
        row("negative seed", {"simulate", "scene.json", "--out", "x.wav", "--seed", "-1"}, "command line: --seed");
        row("no model", {"statistic", "--frames", "none.npy", "--model", "m.json", "--out", "x.npy"},
            "none.npy: cannot be opened");
    }

    void mistakes()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QString, message);
        const Outcome told = run(arguments);
        QCOMPARE(told.code, 2);
        QCOMPARE(told.out, QByteArray());
        QVERIFY2(told.err.startsWith("error: ") && told.err.endsWith('\n') && told.err.count('\n') == 1,
                 told.err.data());
        QVERIFY2(QString::fromUtf8(told.err).contains(message), told.err.data());
        QVERIFY2(told.err.size() < 500, told.err.data());
        for (const char *name : {"e.xml", "t.txt", "x.wav", "x.xyz", "x.npy"})
            QVERIFY2(!QFile::exists(path(name)), name);
        QVERIFY(QDir(folder()).entryList({"*.part"}, QDir::Files | QDir::Hidden).isEmpty());
    }

    void inputsAreNotReplaced_data()
    {
        QTest::addColumn<QStringList>("arguments");
        const auto row = [](const char *name, const QStringList &arguments) { QTest::newRow(name) << arguments; };
        row("metadata by the metadata", {"detect", "rec.sigmf-meta", "--events", "rec.sigmf-meta"});
        row("metadata by the samples", {"detect", "rec.sigmf-data", "--events", "./rec.sigmf-meta"});
        row("both halves", {"straighten", "rec.sigmf-meta", "--out", "rec.sigmf-meta"});
        row("the other half", {"straighten", "rec.sigmf-meta", "--out", "rec.sigmf-data"});
        row("samples as raw", {"inject", "rec.sigmf-data", "--raw-type", "rf32_le", "--raw-rate", "1000", "--snr", "9",
                               "--frequency", "90", "--out", "rec.sigmf-meta"});
        row("recording", {"straighten", "line.wav", "--out", "line.wav"});
        row("recording as the rest", {"straighten", "line.wav", "--rest", "./line.wav", "--out", "q.wav"});
        row("recording with a line",
            {"inject", "line.wav", "--snr", "9", "--frequency", "90", "--out", "symbolic.wav"});
        row("recording by a hard link", {"inject", "line.wav", "--snr", "9", "--frequency", "90", "--out", "hard.wav"});
        row("truth beside", {"detect", "line.wav", "--events", "line.truth.json"});
        row("scene", {"detect", "scene.json", "--events", "scene.json"});
        row("scene that is simulated", {"simulate", "scene.json", "--out", "q.wav", "--truth", "scene.json"});
        row("frames", {"detect", "--frames", "y.npy", "--statistic", "y.npy"});
        row("frames of a statistic", {"statistic", "--frames", "y.npy", "--model", "scene.json", "--out", "./y.npy"});
        row("model", {"statistic", "--frames", "y.npy", "--model", "m.json", "--out", "q.npy", "--log", "m.json"});
        row("model of a test", {"sequential", "--frames", "y.npy", "--model", "m.json", "--out", "m.json"});
        row("grid beside", {"detect", "--frames", "y.npy", "--tracks", "y.grid.json"});
        row("grid that is given", {"detect", "--frames", "y.npy", "--grid", "m.json", "--tracks", "m.json"});
        row("annotations", {"detect", "line.wav", "--annotations", "a.selections.txt", "--events", "a.selections.txt"});
        row("settings", {"detect", "line.wav", "--session", "settings.json", "--events", "settings.json"});
        row("recording of a session", {"detect", "s.faintline", "--statistic", "symbolic.npy"});
        row("one of a folder", {"straighten", "night", "--out", "night/20260301_000000.wav"});
        row("one of a list", {"straighten", "night.timeline", "--out", "night/20260301_000000.wav"});
        row("the list", {"straighten", "night.timeline", "--curve", "night.timeline", "--out", "q.wav"});
        row("one of several", {"detect", "line.wav", "hard.wav", "--timeline", "--tracks", "symbolic.wav"});
        row("difference", {"compare", "line.wav", "--difference", "hard.wav"});
        row("fit", {"doppler", "scene.json", "--out", "scene.json"});
        row("what a survey searches", {"survey", "night", "--out", "night/20260301_000000.wav"});
        row("shard", {"merge", "a.csv", "b.csv", "--out", "b.csv"});
        row("experiment", {"evaluate", "scene.json", "--out", "scene.json"});
        row("table of hits", {"cadence", "a.csv", "b.csv", "--events", "a.csv"});
        row("what is listened to", {"listen", "line.wav", "--out", "line.wav"});
    }

    /// Before anything is computed: the settings would take minutes to calibrate.
    void inputsAreNotReplaced()
    {
        QFETCH(QStringList, arguments);
        if (!QFile::exists(path("rec.sigmf-meta"))) {
            QCOMPARE(run({"simulate", "scene.json", "--out", "rec.sigmf-meta"}).code, 0);
            QVERIFY(QDir(folder()).mkpath("night"));
            QVERIFY(QFile::copy(path("line.wav"), path("night/20260301_000000.wav")));
            QVERIFY(QFile::copy(path("truth.json"), path("line.truth.json")));
            QVERIFY(QFile::link("line.wav", path("symbolic.wav")) && QFile::link("line.wav", path("symbolic.npy")));
            QCOMPARE(::link(pathOf("line.wav").c_str(), pathOf("hard.wav").c_str()), 0);
            writeArray(pathOf("y.npy"), {4, 3}, std::vector<float>(12, 1.0f));
            writeBytes(pathOf("night.timeline"), "night/20260301_000000.wav\n");
            writeBytes(pathOf("s.faintline"),
                       R"({"faintline": 1, "recording": {"path": "line.wav", "sha256": ""}, "settings": {}})");
            for (const char *name : {"y.grid.json", "m.json", "a.selections.txt", "settings.json", "a.csv", "b.csv"})
                writeBytes(pathOf(name), "{}");
        }
        const auto everything = [this] {
            QMap<QString, QByteArray> files;
            for (QDirIterator file(folder(), QDir::Files | QDir::Hidden, QDirIterator::Subdirectories);
                 file.hasNext();) {
                const QString name = file.next();
                files[name] = readBytes(name.toStdString());
            }
            return files;
        };
        const auto before = everything();
        const Outcome told = run(arguments);
        QVERIFY2(told.code == 2, told.err.data());
        QCOMPARE(told.out, QByteArray());
        QVERIFY2(told.err.startsWith("error: ") && told.err.count('\n') == 1, told.err.data());
        QVERIFY2(told.err.contains(": is an input and would be replaced; give the output another name"),
                 told.err.data());
        QVERIFY(everything() == before);
    }

    void fullDiskIsAFailure()
    {
        // No file may grow beyond 1000 bytes: what a full disk does, the machine's fault and not the user's.
        for (const QString name : {"full.wav", "full.caf", "full.flac", "full.sigmf-meta"}) {
            const Outcome told = run({"simulate", "scene.json", "--out", name}, [] {
                std::signal(SIGXFSZ, SIG_IGN);
                const rlimit limit{1000, 1000};
                setrlimit(RLIMIT_FSIZE, &limit);
            });
            QVERIFY2(told.code == 1, told.err.data());
            QVERIFY2(told.err.startsWith("error: full") && told.err.count('\n') == 1, told.err.data());
        }
        QVERIFY(QDir(folder()).entryList({"full*"}, QDir::Files | QDir::Hidden).isEmpty());
    }

    void interruptLeavesNothing_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<int>("signal");
        QTest::newRow("simulate") << QStringList{"simulate", "endless.json", "--out", "endless.w64"} << SIGINT;
        QTest::newRow("detect") << QStringList{"detect",      "endless.json", "--set",    "spectrogram.windowSeconds=1",
                                               "--statistic", "endless.npy",  "--events", "endless.csv"}
                                << SIGINT;
        QTest::newRow("terminated") << QStringList{"detect",      "endless.json",
                                                   "--set",       "spectrogram.windowSeconds=1",
                                                   "--statistic", "endless.npy"}
                                    << SIGTERM;
    }

    void interruptLeavesNothing()
    {
        QFETCH(QStringList, arguments);
        QFETCH(int, signal);
        // A day of noise: more than any machine makes before it is told to stop.
        writeBytes(pathOf("endless.json"), R"({"sampleRateHz": 8000, "durationSeconds": 86400})");
        QProcess process;
        process.setWorkingDirectory(folder());
        process.start(program, arguments);
        QVERIFY(process.waitForStarted(patience));
        const auto halfWritten = [&] {
            return QDir(folder()).entryList({"endless*.part", ".endless*"}, QDir::Files | QDir::Hidden);
        };
        QTRY_VERIFY_WITH_TIMEOUT(!halfWritten().isEmpty() || process.state() == QProcess::NotRunning, patience);
        QVERIFY2(process.state() == QProcess::Running, process.readAllStandardError().data());
        QCOMPARE(::kill(static_cast<pid_t>(process.processId()), signal), 0);
        QVERIFY(process.waitForFinished(patience));
        QCOMPARE(process.exitStatus(), QProcess::NormalExit);
        QCOMPARE(process.exitCode(), 1);
        QCOMPARE(process.readAllStandardError(), QByteArray("error: interrupted: no incomplete output was left\n"));
        QCOMPARE(process.readAllStandardOutput(), QByteArray());
        QCOMPARE(QDir(folder()).entryList({"endless*", ".endless*"}, QDir::Files | QDir::Hidden),
                 QStringList{"endless.json"});
    }
};

FAINTLINE_TEST(tst_cliMistakes)
#include "tst_cliMistakes.moc"
