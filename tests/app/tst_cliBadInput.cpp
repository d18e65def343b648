#include "signal/formats/NumPy.h"
#include "support/recordings.h"
#include "support/slowdown.h"
#include "support/test.h"

#include <QImage>

#include <functional>

#include <sys/resource.h>

using namespace faintline;
using namespace faintline::test;

/// Hostile files and impossible places for results, from outside: an exit code that is kept, one readable line, and
/// nothing left behind.
class tst_cliBadInput : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase();

    void foreignText_data();
    void foreignText();
    void deepNesting_data();
    void deepNesting();
    void wrongKinds_data();
    void wrongKinds();
    void changedBytes_data();
    void changedBytes();
    void scenesAreNamed();
    void sizesWithoutMemory();
    void moreThreadsThanThereAre();
    void numbersThatAreNone_data();
    void numbersThatAreNone();
    void placesThatCannotBeWritten_data();
    void placesThatCannotBeWritten();
    void sigmfIsReadAndMadeAgain();
    void annotationsThatAreNoFile();
    void picturesCutOff();
    void reportOfALesson();
    void windowWithoutADisplay();

private:
    struct Outcome {
        int code = -1;
        QByteArray out;
        QByteArray err;
    };

    Outcome run(const QString &name, const QStringList &arguments, const std::function<void()> &inChild = {}) const
    {
        constexpr int patience = 120'000 * slowdown; // ms, for a machine that is busy with other things
        QProcess process;
        process.setWorkingDirectory(m_folder.path());
        if (inChild)
            process.setChildProcessModifier(inChild);
        process.start(QStringLiteral(FAINTLINE_BINARY_DIR "/app/") + name, arguments);
        if (!process.waitForFinished(patience) || process.exitStatus() != QProcess::NormalExit) {
            qWarning("%s: did not end by itself", qPrintable(arguments.join(' ')));
            return {};
        }
        return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
    }
    Outcome run(const QStringList &arguments) const { return run(QStringLiteral("faintline-cli"), arguments); }

    /// What every refusal has to be.
    static bool isOneLine(const Outcome &told)
    {
        return told.err.startsWith("error: ") && told.err.endsWith('\n') && told.err.count('\n') == 1
               && told.err.size() < 1100 && QString::fromUtf8(told.err).toUtf8() == told.err
               && !told.err.contains("exception") && !told.err.contains("failure: ");
    }

    std::string pathOf(const QString &name) const { return m_folder.filePath(name).toStdString(); }
    QByteArray content(const QString &name) const { return readBytes(pathOf(name)); }
    QStringList named(const QString &pattern) const
    {
        return QDir(m_folder.path()).entryList({pattern}, QDir::Files | QDir::Hidden);
    }

    QTemporaryDir m_folder;
};

namespace {

const QByteArray scene = R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 10, "seed": 3,
        "lines": [{"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 2, "durationSeconds": 6,
        "frequencyHz": 210}]})";
const QByteArray pings = R"({"kind": "pings", "pings": 4, "rangeCells": 20, "beams": 4})";
const QByteArray model =
    R"({"axes": [{"cells": 4, "rates": [-1, 0, 1], "rateChange": [0.4, 0.3]}], "likelihood": {"kind": "linear"}})";
const QByteArray experiment =
    R"({"kind": "lines", "runs": 2, "frames": 60, "blockFrames": 30, "blockBins": 30, "durationWindows": 10,
        "snrDb": [3], "detectors": [{"name": "SMD", "settings": {"detector.kind": "smd"}}]})";
const QStringList settings{"--set", "spectrogram.windowSeconds=0.5", "--set", "decide.falseAlarmsPerHour=2"};

/// Two gibibytes of addresses, a third of which every thread wants for its stack.
void limitMemory()
{
    if (isSanitized) // which wants all there are
        return;
    constexpr rlim_t mebibyte = 1 << 20;
    const rlimit all{2048 * mebibyte, 2048 * mebibyte};
    const rlimit stack{700 * mebibyte, 700 * mebibyte};
    setrlimit(RLIMIT_AS, &all);
    setrlimit(RLIMIT_STACK, &stack);
}

} // namespace

void tst_cliBadInput::initTestCase()
{
    writeBytes(pathOf("scene.json"), scene);
    writeBytes(pathOf("pings.json"), pings);
    writeBytes(pathOf("model.json"), model);
    writeBytes(pathOf("experiment.json"), experiment);
    for (const char *name : {"line.wav", "line.sigmf-meta"})
        QCOMPARE(run({"simulate", "scene.json", "--out", name}).err, QByteArray());
    QCOMPARE(run({"evaluate", "experiment.json", "--shard", "1/2", "--out", "shard.json"}).err, QByteArray());
    NumPyWriter frames(pathOf("frames.npy"), {3, 4});
    frames.write(std::vector<float>(12, 1.0f));
    frames.finish();
}

void tst_cliBadInput::foreignText_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QByteArray>("text");
    const QByteArray longKey = "{\"" + QByteArray(100000, 'a') + "\": 1}";
    QTest::newRow("key of two lines") << QStringList{"info", "bad.json"} << QByteArray(R"({"a\nb\u0007": 1})");
    QTest::newRow("long key") << QStringList{"info", "bad.json"} << longKey;
    QTest::newRow("long setting") << QStringList{"detect", "line.wav", "--summary", "--session", "bad.json"} << longKey;
    QTest::newRow("value of two lines") << QStringList{"simulate", "bad.json", "--out", "o.wav"}
                                        << QByteArray(R"({"seed": "a\nb"})");
    QTest::newRow("NumPy header")
        << QStringList{"detect", "--frames", "bad.json", "--summary"}
        << "\x93NUMPY\x01" + QByteArray(1, '\0') + "\x40" + QByteArray(1, '\0')
               + QByteArray("{'descr': '<f4', 'fortran_order': False, 'shape': (3\n\xff\x01,), }").leftJustified(64);
}

void tst_cliBadInput::foreignText()
{
    QFETCH(QStringList, arguments);
    QFETCH(QByteArray, text);
    writeBytes(pathOf("bad.json"), text);
    const Outcome told = run(arguments);
    QCOMPARE(told.code, 2);
    QVERIFY2(isOneLine(told), told.err.left(2000).constData());
}

void tst_cliBadInput::deepNesting_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("scene") << QStringList{"info", "deep.json"};
    QTest::newRow("session") << QStringList{"detect", "line.wav", "--summary", "--session", "deep.json"};
    QTest::newRow("annotations") << QStringList{"detect", "line.wav",      "--events",
                                                "o.csv",  "--annotations", "deep.json"};
    QTest::newRow("model") << QStringList{"statistic", "--frames", "frames.npy", "--model",
                                          "deep.json", "--out",    "o.npy"};
    QTest::newRow("experiment") << QStringList{"evaluate", "deep.json", "--out", "o.csv"};
    QTest::newRow("shard") << QStringList{"merge", "deep.json", "--out", "o.csv"};
    QTest::newRow("SigMF") << QStringList{"info", "deep.sigmf-meta"};
}

void tst_cliBadInput::deepNesting()
{
    QFETCH(QStringList, arguments);
    // Whatever goes through it by calling itself would run out of stack.
    const QByteArray deep = R"({"settings": )" + QByteArray(200000, '[') + QByteArray(200000, ']') + "}";
    writeBytes(pathOf("deep.json"), deep);
    writeBytes(pathOf("deep.sigmf-meta"), deep);
    const Outcome told = run(arguments);
    QCOMPARE(told.code, 2);
    QVERIFY2(isOneLine(told) && told.err.contains("is nested more than 100 levels deep"), told.err.constData());
}

void tst_cliBadInput::wrongKinds_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("message");
    const QStringList evaluate{"evaluate", "bad.json", "--out", "o.csv"};
    const QStringList merge{"merge", "bad.json", "--out", "o.csv"};
    const QStringList annotated{"detect", "line.wav", "--events", "o.csv", "--annotations", "bad.json"};
    const char *const otherKind = "has the wrong type or is missing: type must be number, but is string";
    QTest::newRow("kind of an experiment")
        << evaluate << QByteArray(R"({"kind": 7})") << "bad.json.kind: must be lines, injection";
    QTest::newRow("version of a shard") << merge
                                        << QByteArray(
                                               R"({"faintlineCampaign": "1", "experiment": {}, "thresholds": []})")
                                        << "bad.json: is not a campaign";
    const QByteArray shard = R"({"faintlineCampaign": 1, "thresholds": ["high"], "experiment": )"
                             + QByteArray(experiment).replace('\n', ' ') + "}\n";
    QTest::newRow("thresholds of a shard")
        << merge << shard << QStringLiteral("bad.json, line 1: thresholds: ") + otherKind;
    const QByteArray few = R"({"faintlineCampaign": 1, "thresholds": [], "experiment": )"
                           + QByteArray(experiment).replace('\n', ' ')
                           + "}\n{\"noise\": [[1]], \"signal\": [[[1]]], \"run\": ";
    QTest::newRow("run of a shard") << merge << few + "1e300}\n"
                                    << "bad.json, line 2: run: must be a whole number";
    QTest::newRow("run before the first") << merge << few + "-1}\n"
                                          << "bad.json, line 2: run = -1: must lie in 0 … 1";
    QTest::newRow("run after the last") << merge << few + "2}\n"
                                        << "bad.json, line 2: run = 2: must lie in 0 … 1";
    const QByteArray sweep =
        R"({"faintlineCampaign": 1, "thresholds": [1], "experiment": {"kind": "sweep", "trials": 1, "values": [5],)"
        R"( "parameter": "decide.thresholdNats"}})"
        "\n"
        R"({"run": 0, "signal": [[[1]]], "noise": )";
    for (const char *noise : {"[[1e30, 5]]", "[[null, 5]]", "[[-1, 5]]", "[[1, 1e30]]"})
        QTest::newRow(noise) << merge << sweep + noise + "}\n"
                             << "bad.json, line 2: must contain values for each of "
                                "the 1 detectors";
    QTest::newRow("a folder as a shard") << QStringList{"merge", ".", "--out", "o.csv"} << QByteArray()
                                         << ".: is not a file";
    QTest::newRow("begin of an event") << annotated << QByteArray(R"({"events": [{"t_onset": "soon", "t_end": 2}]})")
                                       << QStringLiteral("bad.json, event 1: ") + otherKind;
    QTest::newRow("event without an end") << annotated << QByteArray(R"({"events": [{"t_onset": 1}]})")
                                          << "bad.json, event 1: has the wrong type or is missing: key 't_end' not "
                                             "found";
    QTest::newRow("events that are none")
        << annotated << QByteArray(R"({"events": "none"})") << "expected an object or a list, found a string";
}

void tst_cliBadInput::wrongKinds()
{
    QFETCH(QStringList, arguments);
    QFETCH(QByteArray, text);
    QFETCH(QString, message);
    writeBytes(pathOf("bad.json"), text);
    const Outcome told = run(arguments);
    QCOMPARE(told.code, 2);
    QVERIFY2(isOneLine(told) && QString::fromUtf8(told.err).contains(message), told.err.constData());
    QVERIFY(named("o.csv*").isEmpty());
}

void tst_cliBadInput::changedBytes_data()
{
    QTest::addColumn<QString>("file");
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("scene") << "scene.json" << QStringList{"simulate", "@", "--out", "o.wav"};
    QTest::newRow("pings") << "pings.json" << QStringList{"simulate", "@", "--out", "o.npy"};
    QTest::newRow("model") << "model.json"
                           << QStringList{"statistic", "--frames", "frames.npy", "--model", "@", "--out", "o.npy"};
    QTest::newRow("frames") << "frames.npy"
                            << QStringList{"statistic", "--frames", "@", "--model", "model.json", "--out", "o.npy"};
    QTest::newRow("shard") << "shard.json" << QStringList{"merge", "@", "--out", "o.csv"};
    QTest::newRow("recording") << "line.wav" << QStringList{"info", "@"};
}

void tst_cliBadInput::changedBytes()
{
    QFETCH(QString, file);
    QFETCH(QStringList, arguments);
    const QByteArray whole = content(file);
    QRandomGenerator random(1);
    for (int trial = 0; trial < 30; ++trial) {
        QByteArray bytes = whole;
        for (int change = 0; change <= trial % 3; ++change) {
            const int at = random.bounded(int(std::min<qsizetype>(bytes.size(), 300)));
            if (random.bounded(4) == 0)
                bytes.remove(at, 1 + random.bounded(20));
            else
                bytes[at] = static_cast<char>(random.bounded(256));
        }
        const QString name = QStringLiteral("changed.") + QFileInfo(file).suffix();
        writeBytes(pathOf(name), bytes);
        QStringList own = arguments;
        own.replaceInStrings(QStringLiteral("@"), name);
        const Outcome told = run(own);
        QVERIFY2((told.code == 0 && told.err.isEmpty()) || (told.code > 0 && isOneLine(told) && named("o.*").isEmpty()),
                 told.err + "for\n" + bytes.left(400));
        for (const QString &made : named("o.*"))
            QFile::remove(m_folder.filePath(made));
    }
}

void tst_cliBadInput::scenesAreNamed()
{
    writeBytes(pathOf("wrong.json"), R"({"sampleRateHz": 1000, "durationSeconds": 9, "lines": [{"snrDb": "loud"}]})");
    for (const QStringList &arguments :
         {QStringList{"info", "wrong.json"}, QStringList{"simulate", "wrong.json", "--out", "o.wav"}})
        QCOMPARE(run(arguments).err,
                 QByteArray("error: wrong.json: lines[0].snrDb = loud: must lie in -60 … 120 dB\n"));
}

void tst_cliBadInput::sizesWithoutMemory()
{
    // The file asks for more cells than there is memory; what it is to be run on has four.
    writeBytes(
        pathOf("large.json"),
        R"({"axes": [{"cells": 30000, "integrate": true}, {"cells": 30000}], "likelihood": {"kind": "exponential",
           "snr": 4}})");
    const QStringList arguments{"sequential", "--frames", "frames.npy", "--model", "large.json", "--out", "o.json"};
    const Outcome told = run("faintline-cli", arguments, limitMemory);
    QCOMPARE(told.err, QByteArray("error: large.json: has 30000 × 30000 cells, but the frames of frames.npy have 4\n"));
    QCOMPARE(told.code, 2);
}

void tst_cliBadInput::moreThreadsThanThereAre()
{
    writeBytes(pathOf("many.json"), QByteArray(experiment).replace(R"("runs": 2)", R"("runs": 600)"));
    QCOMPARE(run({"evaluate", "many.json", "--threads", "1", "--out", "one.csv"}).err, QByteArray());
    const Outcome told =
        run("faintline-cli", {"evaluate", "many.json", "--threads", "600", "--out", "many.csv"}, limitMemory);
    QCOMPARE(told.err, QByteArray());
    QCOMPARE(content("many.csv"), content("one.csv"));
}

void tst_cliBadInput::numbersThatAreNone_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("message");
    const QStringList inject{"inject", "line.wav", "--snr", "3", "--frequency", "100", "--out", "o.wav", "--reference"};
    QTest::newRow("cells") << QStringList{"compare", "line.wav", "--cells", "nan"} << "--cells: must be a number";
    QTest::newRow("frames") << QStringList{"compare", "line.wav", "--frames", "nan"} << "--frames: must be a number";
    QTest::newRow("reference below 0") << inject + QStringList{"-1"} << "--reference -1: must be above 0 s";
    QTest::newRow("reference that is none") << inject + QStringList{"nan"} << "--reference nan: must be above 0 s";
}

void tst_cliBadInput::numbersThatAreNone()
{
    QFETCH(QStringList, arguments);
    QFETCH(QString, message);
    const Outcome told = run(arguments);
    QCOMPARE(told.code, 2);
    QVERIFY2(isOneLine(told) && QString::fromUtf8(told.err).contains(message), told.err.constData());
}

void tst_cliBadInput::placesThatCannotBeWritten_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::newRow("tracks") << QStringList{"detect", "scene.json", "--events", "o.csv", "--tracks", "no/t.csv"};
    QTest::newRow("statistic") << QStringList{"detect", "scene.json", "--events", "o.csv", "--statistic", "no/s.npy"};
    QTest::newRow("truth") << QStringList{"simulate", "scene.json", "--out", "o.wav", "--truth", "no/t.json"};
    QTest::newRow("truth of pings") << QStringList{"simulate", "pings.json", "--out", "o.npy", "--truth", "/dev/full"};
    QTest::newRow("truth of an injection")
        << QStringList{"inject", "line.wav", "--snr", "3", "--frequency", "100", "--out", "o.wav", "--truth", "."};
    QTest::newRow("log") << QStringList{"statistic", "--frames", "frames.npy", "--model", "model.json",
                                        "--out",     "o.npy",    "--log",      "no/l.csv"};
    QTest::newRow("chart") << QStringList{"evaluate", "experiment.json", "--out", "o.csv", "--chart", "no/c.svg"};
    QTest::newRow("difference") << QStringList{"compare", "line.wav", "--events", "o.csv", "--difference", "no/d.npy"};
    QTest::newRow("no name") << QStringList{"merge", "shard.json", "--out", ""};
}

void tst_cliBadInput::placesThatCannotBeWritten()
{
    QFETCH(QStringList, arguments);
    const Outcome told = run(arguments);
    QCOMPARE(told.code, 2);
    QVERIFY2(isOneLine(told), told.err.constData());
    QCOMPARE(told.out, QByteArray()); // refused before anything was done
    QCOMPARE(named("o.*") + named("*.part"), QStringList());
}

void tst_cliBadInput::sigmfIsReadAndMadeAgain()
{
    // Annotations as SigMF need no samples of their own.
    writeBytes(pathOf("judged.sigmf-meta"), R"({"global": {"core:sample_rate": 1000}, "annotations": [
        {"core:sample_start": 1000, "core:sample_count": 8000, "core:freq_lower_edge": 200, "core:freq_upper_edge": 220,
         "core:label": "mains", "faintline:review": "rejected"}]})");
    const Outcome told =
        run(QStringList{"detect", "line.sigmf-meta", "--annotations", "judged.sigmf-meta", "--events", "judged.csv"}
            + settings);
    QCOMPARE(told.err, QByteArray());
    QCOMPARE(told.code, 0);
    QVERIFY2(content("judged.csv").contains("rejected"), content("judged.csv").constData());
    QCOMPARE(run({"replay", "judged.csv"}).out, QByteArray("judged.csv: the same bytes\n"));

    // All that they were made from is looked at: the annotations, and both files of the recording.
    for (const char *name : {"judged.sigmf-meta", "line.sigmf-meta", "line.sigmf-data"}) {
        const QByteArray before = content(name);
        writeBytes(pathOf(name), before + " ");
        const Outcome replayed = run({"replay", "judged.csv"});
        QCOMPARE(replayed.code, 2);
        QVERIFY2(replayed.err.startsWith(QByteArray("error: ") + name + ": is not the input of"),
                 replayed.err.constData());
        writeBytes(pathOf(name), before);
    }
}

void tst_cliBadInput::annotationsThatAreNoFile()
{
    const Outcome told = run(QStringList{"detect", "line.wav", "--annotations", ".", "--events", "o.csv"} + settings);
    QCOMPARE(told.code, 2);
    QCOMPARE(told.err, QByteArray("error: .: is a folder; expected a table of text\n"));
    QVERIFY(named("o.csv*").isEmpty());
}

void tst_cliBadInput::picturesCutOff()
{
    QImage picture(64, 64, QImage::Format_RGB32);
    for (int i = 0; i < 64 * 64; ++i)
        picture.setPixel(i % 64, i / 64, static_cast<uint>(i * 2654435761u)); // long, as noise is
    QVERIFY(picture.save(m_folder.filePath("whole.png")));
    const QByteArray whole = content("whole.png");
    for (const qsizetype length : {whole.size() / 2, qsizetype(40), qsizetype(8), qsizetype(0)}) {
        writeBytes(pathOf("cut.png"), whole.left(length));
        for (const QStringList &arguments :
             {QStringList{"replay", "cut.png"}, QStringList{"check-pictures", "whole.png", "cut.png"}}) {
            const Outcome told = run(QStringLiteral("faintline"), arguments);
            QCOMPARE(told.code, 2);
            QVERIFY2(isOneLine(told) && told.err.contains("cut.png: cannot be read as PNG"), told.err.constData());
        }
    }
}

void tst_cliBadInput::reportOfALesson()
{
    writeBytes(pathOf("lesson.json"), R"({"steps": []})"); // one that cannot be opened, either
    const Outcome told = run(QStringLiteral("faintline"), {"report", "lesson.json", "--out", "o.html"});
    QCOMPARE(told.code, 2);
    QCOMPARE(told.err,
             QByteArray("error: lesson.json: is a lesson; a report requires a recording, pings or a session\n"));
    QVERIFY(named("o.html*").isEmpty());
}

void tst_cliBadInput::windowWithoutADisplay()
{
    if (!QFile::exists(QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline")))
        QSKIP("no window is built");
    const Outcome told = run(QStringLiteral("faintline"), {}, [] {
        ::unsetenv("DISPLAY");
        ::unsetenv("WAYLAND_DISPLAY");
        ::setenv("QT_QPA_PLATFORM", "xcb", 1);
    });
    QCOMPARE(told.code, 1);
    QVERIFY2(isOneLine(told) && told.err.contains("no display is available"), told.err.constData());
}

FAINTLINE_TEST(tst_cliBadInput)
#include "tst_cliBadInput.moc"
