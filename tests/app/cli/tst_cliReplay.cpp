#include "app/cli/CommandLineTest.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// replay: what the program wrote is made again from what stands beside it, and compared.
class tst_cliReplay : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase() { simulateLine(); }

    void resultsAreMadeAgain();
    void nothingElseIsTouched_data();
    void nothingElseIsTouched();
    void onlyItsOwnFolderIsRead();
    void helpIsNoResult();
    void runsThatAreNone();
    void whatTheWindowMadeOfATrack_data();
    void whatTheWindowMadeOfATrack();

private:
    Outcome runAtHome(const QStringList &arguments, const QString &home) const;
};

namespace {

/// Every file and folder below one, with its content.
QMap<QString, QByteArray> everything(const QString &folder)
{
    QMap<QString, QByteArray> all;
    for (QDirIterator entry(folder, QDir::AllEntries | QDir::Hidden | QDir::System | QDir::NoDotAndDotDot,
                            QDirIterator::Subdirectories);
         entry.hasNext();) {
        const QString path = entry.next();
        all[path] = entry.fileInfo().isDir()
                        ? "folder"
                        : QCryptographicHash::hash(readBytes(path.toStdString()), QCryptographicHash::Sha256);
    }
    return all;
}

QByteArray provenance(const QByteArray &arguments, const QByteArray &outputs)
{
    return R"({"faintline": "0", "folder": ".", "inputs": [], "arguments": )" + arguments + R"(, "outputs": )" + outputs
           + "}";
}

} // namespace

/// In the folder `gift` of a home folder, where calibrations would be kept.
CommandLineTest::Outcome tst_cliReplay::runAtHome(const QStringList &arguments, const QString &home) const
{
    QProcess process;
    QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
    environment.insert("HOME", home);
    environment.remove("FAINTLINE_CACHE");
    environment.remove("XDG_CACHE_HOME");
    process.setProcessEnvironment(environment);
    process.setWorkingDirectory(home + "/gift");
    process.start(program, arguments);
    if (!process.waitForFinished(patience) || process.exitStatus() != QProcess::NormalExit)
        return {};
    return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
}

void tst_cliReplay::nothingElseIsTouched_data()
{
    QTest::addColumn<QByteArray>("told");
    QTest::newRow("an output that is not told of") << provenance(
        R"(["detect", "line.wav", "--set", "spectrogram.windowSeconds=0.5", "--events", "gift.csv", "--tracks",
           "../mine.csv"])",
        R"(["gift.csv"])");
    QTest::newRow("an output far away") << provenance(
        R"(["simulate", "scene.json", "--out", "gift.wav", "--truth=../mine.json"])", R"(["gift.wav"])");
    QTest::newRow("an experiment with a chart called detect") << provenance(
        R"(["evaluate", "experiment.json", "--out", "../mine.csv", "--chart", "detect"])", R"(["detect"])");
    QTest::newRow("shards, one of them called detect")
        << provenance(R"(["evaluate", "merge", "detect", "--out", "../mine.csv"])", R"(["detect"])");
    QTest::newRow("a statistic of frames called inject") << provenance(
        R"(["statistic", "--frames", "inject", "--model", "model.json", "--out", "../mine.npy", "--log",
           "../mine.csv"])",
        R"(["inject"])");
    QTest::newRow("a command after threads") << provenance(
        R"(["--threads", "1", "evaluate", "experiment.json", "--out=../mine.csv", "--chart=detect"])", R"(["detect"])");
    QTest::newRow("frames with their grid")
        << provenance(R"(["simulate", "pings.json", "--out", "../mine.npy"])", R"(["../mine.npy"])");
    QTest::newRow("made in the folder above")
        << QByteArray(provenance(R"(["simulate", "gift/scene.json", "--out", "mine.wav"])", R"(["mine.wav"])"))
               .replace("\"folder\": \".\"", "\"folder\": \"..\"");
    QTest::newRow("an experiment of the window")
        << QByteArray(R"({"version": "0", "outputs": ["../mine.csv"], "experiment": {"kind": "sweep", "trials": 2,
        "durationSeconds": 2, "sampleRateHz": 100, "parameter": "decide.thresholdNats", "values": [5, 6],
        "out": "../mine.csv"}})");
    QTest::newRow("events of the window") << QByteArray(R"({"version": "0", "outputs": ["gift.csv"], "settings": {},
        "recording": {"path": "../mine.csv", "name": "../mine", "scenario": {"kind": "lines", "sampleRateHz": 1000,
        "durationSeconds": 20}}})");
    QTest::newRow("a link that leads away")
        << provenance(R"(["simulate", "scene.json", "--out", "gift.wav", "--truth", "link.json"])", R"(["gift.wav"])");
}

void tst_cliReplay::nothingElseIsTouched()
{
    QFETCH(QByteArray, told);
    const QTemporaryDir home;
    const auto at = [&](const char *name) { return home.filePath(name).toStdString(); };
    QVERIFY(QDir(home.path()).mkpath("gift"));
    for (const char *mine : {"mine.csv", "mine.json", "mine.npy", "mine.grid.json"})
        writeBytes(at(mine), "worth a year");
    writeBytes(at("gift/line.wav"), content("line.wav"));
    writeBytes(at("gift/scene.json"), content("scene.json"));
    writeBytes(at("gift/pings.json"), R"({"kind": "pings", "pings": 4, "rangeCells": 20, "beams": 4})");
    writeBytes(at("gift/experiment.json"),
               R"({"kind": "lines", "runs": 2, "frames": 60, "blockFrames": 30, "blockBins": 30,
        "durationWindows": 10, "snrDb": [3], "detectors": [{"name": "SMD", "settings": {"detector.kind": "smd",
        "smd.reset": "fixed"}}]})");
    writeBytes(
        at("gift/model.json"),
        R"({"axes": [{"cells": 4, "rates": [-1, 0, 1], "rateChange": [0.4, 0.3]}], "likelihood": {"kind": "linear"}})");
    writeArray(at("gift/inject"), {3, 4}, std::vector<float>(12, 1.0f));
    QVERIFY(QFile::link(home.filePath("mine.json"), home.filePath("gift/link.json")));
    if (told.contains("merge"))
        QCOMPARE(runAtHome({"evaluate", "experiment.json", "--shard", "1/1", "--out", "detect"}, home.path()).err,
                 QByteArray());
    const QDir gift(home.filePath("gift"));
    QFile::remove(home.filePath(".cache"));
    for (const char *result : {"gift/gift.csv", "gift/gift.wav", "gift/mine.npy"})
        writeBytes(at(result), "look");
    writeBytes(at("gift/gift.provenance.json"), told);
    const QJsonArray outputs = QJsonDocument::fromJson(told)["outputs"].toArray();
    const QString result = QFileInfo(outputs[0].toString()).fileName();
    writeBytes((gift.path() + "/" + result + ".provenance.json").toStdString(), told);
    const auto before = everything(home.path());
    const Outcome outcome = runAtHome({"replay", result}, home.path());
    QVERIFY(outcome.code > 0 && outcome.err.startsWith("error: ") && outcome.err.count('\n') == 1);
    const auto after = everything(home.path());
    QCOMPARE(after.keys(), before.keys());
    QVERIFY(after == before);
}

void tst_cliReplay::onlyItsOwnFolderIsRead()
{
    QVERIFY(QDir(folder()).mkpath("results"));
    QCOMPARE(run(QStringList{"detect", "line.wav", "--events", "results/far.csv"} + lineSettings).code, 0);
    const Outcome refused = run({"replay", "results/far.csv"});
    QCOMPARE(refused.code, 2);
    QCOMPARE(refused.err, QByteArray("error: line.wav: lies outside the folder of far.csv, which requires it; permit "
                                     "replay to read it with --allow FOLDER\n"));
    QCOMPARE(run({"replay", "results/far.csv", "--allow", "."}).out, QByteArray("far.csv: the same bytes\n"));
    QCOMPARE(run({"replay", "results/far.csv", "--allow", "none"}).code, 2);

    // Nor by what is not told of among what went in, nor by a link.
    QVERIFY(QFile::link(path("scene.json"), path("results/link.json")));
    for (const char *scene : {"../scene.json", "link.json"}) {
        QByteArray told = provenance(R"(["simulate", "@", "--out", "far.wav"])", R"(["far.wav"])").replace("@", scene);
        told.replace("\"folder\": \".\"", "\"folder\": \"results\"");
        writeBytes(pathOf("results/far.wav.provenance.json"), told);
        const Outcome outcome = run({"replay", "results/far.wav"});
        QCOMPARE(outcome.code, 2);
        QVERIFY2(outcome.err.contains("lies outside"), outcome.err.constData());
    }

    // Nor by events that the window exported, of a recording that is a link.
    QVERIFY(QFile::link(path("line.wav"), path("results/link.wav")));
    const QByteArray hash = QCryptographicHash::hash(content("line.wav"), QCryptographicHash::Sha256).toHex();
    writeBytes(pathOf("results/shown.csv"), "look");
    writeBytes(pathOf("results/shown.csv.provenance.json"),
               R"({"version": "0", "settings": {}, "recording": {"path": "link.wav", "sha256": ")" + hash + "\"}}");
    const Outcome shown = run({"replay", "results/shown.csv"});
    QCOMPARE(shown.code, 2);
    QVERIFY2(shown.err.contains("lies outside"), shown.err.constData());
    QVERIFY(run({"replay", "results/shown.csv", "--allow", "."}).out.endsWith("shown.csv: differs\n"));

    // Nor by an experiment of the window.
    writeBytes(pathOf("results/curve.csv"), "look");
    writeBytes(pathOf("results/curve.csv.provenance.json"),
               R"({"version": "0", "experiment": {"kind": "injection", "recording": "line.wav",
        "detectors": [{"name": "SMD", "settings": {"detector.kind": "smd"}}]}})");
    const Outcome outcome = run({"replay", "results/curve.csv"});
    QCOMPARE(outcome.code, 2);
    QVERIFY2(outcome.err.contains("lies outside"), outcome.err.constData());
}

/// A curve that the window exported of a sweep that was stopped.
void tst_cliReplay::runsThatAreNone()
{
    writeBytes(pathOf("sweep.csv"), "look");
    for (const char *runs : {"[-1]", "[4]", "[0, 1e300]", "[0.5]"}) {
        writeBytes(pathOf("sweep.csv.provenance.json"),
                   R"({"version": "0", "experiment": {"kind": "sweep", "trials": 2, "durationSeconds": 2,
            "sampleRateHz": 100, "parameter": "decide.thresholdNats", "values": [5, 6]}, "runs": )"
                       + QByteArray(runs) + "}");
        const Outcome outcome = run({"replay", "sweep.csv"});
        QCOMPARE(outcome.code, 2);
        QVERIFY2(outcome.err.startsWith("error: runs"), outcome.err.constData());
    }
}

void tst_cliReplay::whatTheWindowMadeOfATrack_data()
{
    QTest::addColumn<QString>("command");
    QTest::addColumn<QString>("name");
    QTest::addColumn<QByteArray>("made");
    QTest::newRow("fit") << "doppler"
                         << "fit.json"
                         << QByteArray(R"("doppler": {"events": [1], "centreHz": 0.0, "propagation": 343.0})");
    QTest::newRow("straightened recording")
        << "straighten"
        << "straight.wav" << QByteArray(R"("straighten": {"event": 1, "type": "float32"})");
}

/// The window's provenance makes the bytes of the command line.
void tst_cliReplay::whatTheWindowMadeOfATrack()
{
    QFETCH(QString, command);
    QFETCH(QString, name);
    QFETCH(QByteArray, made);
    QCOMPARE(run(QStringList{command, "line.wav", "--event", "1", "--out", name} + lineSettings).code, 0);
    const QByteArray hash = QCryptographicHash::hash(content("line.wav"), QCryptographicHash::Sha256).toHex();
    writeBytes(pathOf((name + ".provenance.json").toUtf8().constData()),
               R"({"version": "0", "settings": {"spectrogram.windowSeconds": 0.5, "decide.falseAlarmsPerHour": 2},
        "recording": {"path": "line.wav", "sha256": ")"
                   + hash + "\"}, " + made + "}");
    const Outcome replayed = run({"replay", name});
    QCOMPARE(replayed.err, QByteArray());
    QVERIFY2(replayed.out.endsWith(name.toUtf8() + ": the same bytes\n"), replayed.out.constData());
    QCOMPARE(replayed.code, 0);
}

void tst_cliReplay::helpIsNoResult()
{
    writeBytes(pathOf("help.csv"), "look");
    writeBytes(pathOf("help.csv.provenance.json"),
               provenance(R"(["detect", "--events", "help.csv", "--help"])", R"(["help.csv"])"));
    const Outcome outcome = run({"replay", "help.csv"});
    QCOMPARE(outcome.code, 2);
    QVERIFY2(outcome.err.contains("invalid command line"), outcome.err.constData());
}

void tst_cliReplay::resultsAreMadeAgain()
{
    QCOMPARE(
        run(QStringList{"detect", "line.wav", "--events", "again.csv", "--statistic=again.npy"} + lineSettings).code,
        0);
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
    QCOMPARE(
        run(QStringList{"detect", "line.wav", "--annotations", "judged.txt", "--events", "judged.csv"} + lineSettings)
            .err,
        QByteArray());
    QVERIFY2(content("judged.csv").contains("rejected") && content("judged.csv").contains("mains"),
             content("judged.csv").constData());
    QCOMPARE(run({"replay", "judged.csv"}).out, QByteArray("judged.csv: the same bytes\n"));
    QCOMPARE(run(QStringList{"detect", "line.wav", "--annotations", "judged.txt", "--summary"} + lineSettings).code, 2);
    const Outcome missing =
        run(QStringList{"detect", "line.wav", "--annotations", "none.txt", "--events", "e.csv"} + lineSettings);
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
    for (const char *tail : {R"("arguments": ["replay", "made.up"], "outputs": ["made.up"]})",
                             R"("arguments": ["detect"], "outputs": []})",
                             R"("arguments": ["detect", "line.wav", "--summary"], "outputs": ["made.up"]})",
                             R"("arguments": 7, "outputs": []})"}) {
        writeBytes(pathOf("made.up.provenance.json"), QByteArray::fromStdString(head + tail));
        replayed = run({"replay", "made.up"});
        QCOMPARE(replayed.code, 2);
        QVERIFY2(replayed.err.contains("made.up.provenance.json"), replayed.err.constData());
        QCOMPARE(replayed.out.count('\n') <= 1, true);
    }
}

FAINTLINE_TEST(tst_cliReplay)
#include "tst_cliReplay.moc"
