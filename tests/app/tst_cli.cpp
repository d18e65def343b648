#include "analysis/analyse.h"
#include "analysis/explain.h"
#include "base/json.h"
#include "exchange/NumPy.h"
#include "exchange/writeEvents.h"
#include "recording/openRecording.h"
#include "support/recordings.h"

#include <QProcess>
#include <QtTest>

#include <csignal>

#include <sys/resource.h>

using namespace faintline;
using namespace faintline::test;

/// The command line from outside: the real program, its files, its exit codes and what it says where.
class tst_cli : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase();

    void helpAndVersion();
    void infoAsText();
    void infoAsJson();
    void describesEverySetting();
    void simulatesTheSameAgain();
    void resultsAreMadeAgain();
    void findsTheLine();
    void statisticHasTheFramesShape();
    void threadsChangeNoByte();
    void keptCalibrationsChangeNoByte();
    void isTheLibrary();
    void explainsItsTerms();
    void comparesTwoSettings();
    void framesInPlaceOfARecording();
    void pingsFromAScene();

    void billonsVectors_data();
    void billonsVectors();
    void parsonsVectors();
    void lnLambdaByEye();
    void sequentialByEye();
    void sequentialInRadarScans();
    void sequentialInUnknownNoise();
    void sequentialInARecording();
    void sequentialMistakes_data();
    void sequentialMistakes();

    void mistakes_data();
    void mistakes();
    void mistakesInFrames_data();
    void mistakesInFrames();
    void fullDiskIsAFailure();
    void interruptLeavesNothing_data();
    void interruptLeavesNothing();
    void oddRecordings_data();
    void oddRecordings();
    void samplesThatAreNoNumbers();

private:
    std::shared_ptr<const Analysis> inLibrary(const char *name, std::vector<float> &statistic) const
    {
        AnalysisSettings own;
        setSetting(own, "spectrogram.windowSeconds", "0.5");
        setSetting(own, "decide.falseAlarmsPerHour", "2");
        return analyse(openRecording(pathOf(name)), own, {}, nullptr, [&](Index, std::span<const float> values) {
            statistic.insert(statistic.end(), values.begin(), values.end());
        });
    }
    QString path(const QString &name) const { return m_folder.filePath(name); }
    std::string pathOf(const char *name) const { return path(name).toStdString(); }
    QByteArray content(const QString &name) const { return readBytes(path(name).toStdString()); }

    QTemporaryDir m_folder;
};

namespace {

    const QString program = QStringLiteral(FAINTLINE_BINARY_DIR "/app/faintline-cli");
    constexpr int patience = 120'000; // ms, for a machine that is busy with other things

    struct Outcome {
        int code = -1;
        QByteArray out;
        QByteArray err;
    };

    /// Runs the program to its end in a folder.
    Outcome run(const QTemporaryDir &folder, const QStringList &arguments, const std::function<void()> &inChild = {})
    {
        QProcess process;
        process.setWorkingDirectory(folder.path());
        if (inChild)
            process.setChildProcessModifier(inChild);
        process.start(program, arguments);
        if (!process.waitForFinished(patience) || process.exitStatus() != QProcess::NormalExit) {
            qWarning("%s: did not end by itself", qPrintable(arguments.join(' ')));
            return {};
        }
        return {process.exitCode(), process.readAllStandardOutput(), process.readAllStandardError()};
    }

    /// Rows of a CSV file without its header, as numbers; empty where one is none.
    std::vector<std::vector<double>> numbersOf(const QByteArray &csv)
    {
        std::vector<std::vector<double>> rows;
        const QList<QByteArray> lines = csv.trimmed().split('\n');
        for (qsizetype i = 1; i < lines.size(); ++i) {
            rows.emplace_back();
            for (const QByteArray &cell : lines[i].split(',')) {
                bool isNumber = false;
                rows.back().push_back(cell.toDouble(&isNumber));
                if (!isNumber)
                    return {};
            }
        }
        return rows;
    }

    /// Fifteen seconds of a line at 210 Hz in thirty of noise.
    const char *const scene = R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 30, "seed": 3,
        "lines": [{"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 8, "durationSeconds": 15, "frequencyHz": 210,
                   "driftHzPerSecond": 0.2}]})";

    const QStringList settings{"--set", "spectrogram.windowSeconds=0.5", "--set", "decide.falseAlarmsPerHour=2"};

    QByteArray shared(const char *name)
    {
        return readBytes(std::string(FAINTLINE_SOURCE_DIR "/../shared/vectors/") + name);
    }

    void writeArray(const std::string &path, const std::vector<Index> &shape, const std::vector<float> &values)
    {
        NumPyWriter writer(path, shape);
        writer.write(values);
        writer.finish();
    }

    /// A WAV file of float samples, its header by hand, so that it may lie.
    QByteArray wav(quint32 rate, quint16 channels, const std::vector<float> &samples)
    {
        const auto number = [](auto value) { return QByteArray(reinterpret_cast<const char *>(&value), sizeof value); };
        const QByteArray data(reinterpret_cast<const char *>(samples.data()), static_cast<qsizetype>(4 * samples.size()));
        return "RIFF" + number(static_cast<quint32>(36 + data.size())) + "WAVEfmt " + number(quint32(16)) + number(quint16(3)) + number(channels)
            + number(rate) + number(static_cast<quint32>(rate * channels * 4)) + number(static_cast<quint16>(channels * 4)) + number(quint16(32))
            + "data" + number(static_cast<quint32>(data.size())) + data;
    }

} // namespace

void tst_cli::initTestCase()
{
    QVERIFY2(QFile::exists(program), "faintline-cli is not built");
    writeBytes(pathOf("scene.json"), scene);
    const Outcome made = run(m_folder, {"simulate", "scene.json", "--out", "line.wav", "--truth", "truth.json"});
    QCOMPARE(made.err, QByteArray());
    QCOMPARE(made.code, 0);
    QCOMPARE(made.out, QByteArray());
    const Outcome found = run(m_folder, QStringList{"detect", "line.wav", "--threads", "1", "--events", "events.csv", "--tracks", "tracks.csv",
                                                    "--statistic", "D.npy"} + settings);
    QCOMPARE(found.err, QByteArray());
    QCOMPARE(found.code, 0);
    QCOMPARE(found.out, QByteArray());
}

void tst_cli::helpAndVersion()
{
    for (const QStringList &arguments : {QStringList{"--help"}, {"detect", "--help"}, {"--version"}}) {
        const Outcome told = run(m_folder, arguments);
        QCOMPARE(told.code, 0);
        QVERIFY(told.out.contains(arguments.last() == "--version" ? "faintline-cli " : "--threads") || told.out.contains("--events"));
        QCOMPARE(told.err, QByteArray());
    }
    const QByteArray all = run(m_folder, {"--help"}).out;
    for (const char *command : {"info", "describe", "detect", "statistic", "explain", "simulate"})
        QVERIFY2(all.contains(command), command);
}

void tst_cli::infoAsText()
{
    const Outcome told = run(m_folder, {"info", "line.wav"});
    QCOMPARE(told.code, 0);
    QCOMPARE(told.err, QByteArray());
    QVERIFY(told.out.contains("WAV, float32"));
    QVERIFY(told.out.contains("1000 Hz"));
    QVERIFY(told.out.contains("30000 samples, 30 s"));
}

void tst_cli::infoAsJson()
{
    writeBytes(pathOf("iq.sigmf-data"), QByteArray(400, '\0'));
    writeBytes(pathOf("iq.sigmf-meta"), R"({"global": {"core:datatype": "ci16_le", "core:sample_rate": 50, "core:version": "1.0.0"},
        "captures": [{"core:sample_start": 0, "core:frequency": 7e6, "core:datetime": "2024-07-26T00:00:00Z"}], "annotations": []})");
    const Outcome told = run(m_folder, {"info", "iq.sigmf-meta", "--json"});
    QCOMPARE(told.code, 0);
    const Json json = parseJson(told.out.toStdString(), "info");
    QCOMPARE(json["container"].get<std::string>(), std::string("SigMF"));
    QCOMPARE(json["sampleType"].get<std::string>(), std::string("ci16_le"));
    QCOMPARE(json["sampleRateHz"].get<double>(), 50.0);
    QCOMPARE(json["channels"].get<int>(), 1);
    QCOMPARE(json["samples"].get<int>(), 100);
    QCOMPARE(json["durationSeconds"].get<double>(), 2.0);
    QCOMPARE(json["complex"].get<bool>(), true);
    QCOMPARE(json["centreHz"].get<double>(), 7e6);
    QCOMPARE(json["startUnixSeconds"].get<double>(), 1721952000.0);
}

void tst_cli::describesEverySetting()
{
    const QByteArray all = run(m_folder, {"describe"}).out;
    for (const auto &field : AnalysisSettings::fields()) {
        QVERIFY2(all.contains(field.name.c_str()), field.name.c_str());
        QVERIFY2(all.contains(field.sentence.c_str()), field.name.c_str());
    }
    for (const Preset &known : presets())
        QVERIFY2(all.contains(known.sentence.c_str()), known.name.c_str());
    QCOMPARE(run(m_folder, {"describe", "decide.falseAlarmsPerHour"}).out,
             QByteArray("decide.falseAlarmsPerHour, 1/h\n    1e-09 … 1e+09; default 1\n"
                        "    False alarms per hour of recording that the threshold allows on noise.\n"));
}

void tst_cli::simulatesTheSameAgain()
{
    QCOMPARE(run(m_folder, {"simulate", "scene.json", "--out", "again.wav", "--threads", "2"}).code, 0);
    QVERIFY(content("again.wav") == content("line.wav"));
    QCOMPARE(run(m_folder, {"simulate", "scene.json", "--out", "other.wav", "--seed", "4"}).code, 0);
    QVERIFY(content("other.wav") != content("line.wav"));
    QCOMPARE(content("other.wav").size(), content("line.wav").size());
    QCOMPARE(run(m_folder, {"simulate", "scene.json", "--out", "short.wav", "--type", "int16"}).code, 0);
    const Json info = parseJson(run(m_folder, {"info", "short.wav", "--json"}).out.toStdString(), "info");
    QCOMPARE(info["sampleType"].get<std::string>(), std::string("int16"));
    const Json truth = readJsonFile(pathOf("truth.json"));
    QCOMPARE(truth["lines"].size(), std::size_t(1));
    QCOMPARE(truth["lines"][0]["snrDb"].get<double>(), 9.0);
    QCOMPARE(truth["lines"][0]["startSeconds"].get<double>(), 8.0);
}

void tst_cli::resultsAreMadeAgain()
{
    QCOMPARE(run(m_folder, QStringList{"detect", "line.wav", "--events", "again.csv", "--statistic=again.npy"} + settings).code, 0);
    Outcome replayed = run(m_folder, {"replay", "again.csv"});
    QCOMPARE(replayed.err, QByteArray());
    QCOMPARE(replayed.out, QByteArray("again.csv: the same bytes\nagain.npy: the same bytes\n"));
    QCOMPARE(replayed.code, 0);

    // What was changed by hand is told from what was made.
    QByteArray changed = content("again.csv");
    changed[changed.size() - 2] = changed[changed.size() - 2] == '1' ? '2' : '1';
    writeBytes(pathOf("again.csv"), changed);
    replayed = run(m_folder, {"replay", "again.csv.provenance.json"});
    QCOMPARE(replayed.code, 1);
    QVERIFY2(replayed.err.contains("again.csv"), replayed.err.constData());

    // What somebody judged elsewhere stands beside the events.
    QCOMPARE(run(m_folder, QStringList{"detect", "line.wav", "--events", "plain.csv"} + settings).code, 0);
    QVERIFY(!content("plain.csv").contains("review"));
    writeBytes(pathOf("judged.txt"), "8\t22\t[rejected] mains\n\\\t205\t218\n");
    QCOMPARE(run(m_folder, QStringList{"detect", "line.wav", "--annotations", "judged.txt", "--events", "judged.csv"} + settings).err,
             QByteArray());
    QVERIFY2(content("judged.csv").contains("rejected") && content("judged.csv").contains("mains"), content("judged.csv").constData());
    QCOMPARE(run(m_folder, {"replay", "judged.csv"}).out, QByteArray("judged.csv: the same bytes\n"));
    QCOMPARE(run(m_folder, QStringList{"detect", "line.wav", "--annotations", "judged.txt", "--summary"} + settings).code, 2);
    const Outcome missing = run(m_folder, QStringList{"detect", "line.wav", "--annotations", "none.txt", "--events", "e.csv"} + settings);
    QCOMPARE(missing.code, 2);
    QCOMPARE(missing.err.count('\n'), 1);

    // So is an input that is another one by now, and a file of which nothing is known.
    QCOMPARE(run(m_folder, {"simulate", "scene.json", "--out", "input.wav", "--seed", "5"}).code, 0);
    QCOMPARE(run(m_folder, QStringList{"detect", "input.wav", "--events", "input.csv"} + settings).code, 0);
    QCOMPARE(run(m_folder, {"simulate", "scene.json", "--out", "input.wav", "--seed", "6"}).code, 0);
    replayed = run(m_folder, {"replay", "input.csv"});
    QCOMPARE(replayed.code, 2);
    QVERIFY2(replayed.err.contains("input.wav"), replayed.err.constData());
    QCOMPARE(run(m_folder, {"replay", "scene.json"}).code, 2);

    // A provenance that somebody made up runs nothing.
    const std::string head = R"({"faintline": "0", "folder": ".", "inputs": [], )";
    for (const char *tail : {R"("arguments": ["replay", "made.up"], "outputs": ["made.up"]})", R"("arguments": ["detect"], "outputs": []})",
                             R"("arguments": ["detect", "line.wav", "--summary"], "outputs": ["made.up"]})", R"("arguments": 7, "outputs": []})"}) {
        writeBytes(pathOf("made.up.provenance.json"), QByteArray::fromStdString(head + tail));
        replayed = run(m_folder, {"replay", "made.up"});
        QCOMPARE(replayed.code, 2);
        QVERIFY2(replayed.err.contains("made.up.provenance.json"), replayed.err.constData());
        QCOMPARE(replayed.out.count('\n') <= 1, true);
    }
}

void tst_cli::findsTheLine()
{
    // The line runs from 210 Hz at 8 s to 213 Hz at 23 s; a window is 0.5 s long, a resolution cell 2 Hz wide.
    const QByteArray csv = content("events.csv");
    QVERIFY(csv.startsWith("event,t_onset,t_detect,t_end,f,drift_hz_per_s,statistic"));
    const auto events = numbersOf(csv);
    QCOMPARE(events.size(), std::size_t(1));
    const std::vector<double> &event = events[0];
    QVERIFY2(std::abs(event[1] - 8.0) < 1.5, csv.data());
    QVERIFY2(event[2] >= event[1] && event[2] < 16.0, csv.data());
    QVERIFY2(event[3] > 22.0, csv.data());
    QVERIFY2(std::abs(event[4] - (210.0 + 0.2 * (event[2] - 8.0))) < 2.5, csv.data());

    const QByteArray tracksCsv = content("tracks.csv");
    QVERIFY(tracksCsv.startsWith("track,t,f,statistic\n"));
    const auto rows = numbersOf(tracksCsv);
    QCOMPARE(rows.front()[1], event[1]); // from onset …
    QCOMPARE(rows.back()[1], event[3]);  // … to end, a row per frame
    QCOMPARE(std::ssize(rows), static_cast<Index>(std::llround((event[3] - event[1]) / 0.25)) + 1);
    for (const std::vector<double> &row : rows)
        if (row[1] > 10.0 && row[1] < 22.0)
            QVERIFY2(std::abs(row[2] - (210.0 + 0.2 * (row[1] - 8.0))) <= 3.0, tracksCsv.data());
}

void tst_cli::statisticHasTheFramesShape()
{
    // 30 s of 0.5-s windows that overlap by half; transforms of 1000 samples.
    const NumPyArray array = readNumPy(pathOf("D.npy"));
    QCOMPARE(array.shape, (std::vector<Index>{119, 501}));
    QVERIFY(std::ranges::all_of(array.values, [](float value) { return std::isfinite(value); }));
}

void tst_cli::threadsChangeNoByte()
{
    const Outcome two = run(m_folder, QStringList{"detect", "line.wav", "--threads", "2", "--events", "events2.csv", "--tracks", "tracks2.csv",
                                                  "--statistic", "D2.npy", "--summary", "--progress", "json"} + settings);
    QCOMPARE(two.code, 0);
    QVERIFY(content("events2.csv") == content("events.csv"));
    QVERIFY(content("tracks2.csv") == content("tracks.csv"));
    QVERIFY(content("D2.npy") == content("D.npy"));

    // On the way: the summary where results go, progress where it does not get between them.
    QVERIFY2(two.out.startsWith("119 frames of 501 cells, 0.25 s a frame\n"), two.out.data());
    QVERIFY2(two.out.contains("\n1 event(s)\n"), two.out.data());
    double last = 0.0;
    for (const QByteArray &line : two.err.trimmed().split('\n')) {
        const Json json = parseJson(line.toStdString(), "progress");
        QVERIFY2(json["progress"].get<double>() >= last, two.err.data());
        last = json["progress"].get<double>();
        QVERIFY(json["doing"].is_string());
    }
    QCOMPARE(last, 1.0);
}

void tst_cli::keptCalibrationsChangeNoByte()
{
    const QByteArray usual = qgetenv("FAINTLINE_CACHE");
    const QString folder = path("cache");
    for (const QString &cache : {QStringLiteral("off"), folder, folder}) { // none, made, read back
        qputenv("FAINTLINE_CACHE", cache.toLocal8Bit());
        const Outcome outcome = run(m_folder, QStringList{"detect", "line.wav", "--events", "kept.csv", "--tracks", "keptTracks.csv",
                                                          "--statistic", "kept.npy"} + settings);
        QCOMPARE(outcome.code, 0);
        QVERIFY(content("kept.csv") == content("events.csv"));
        QVERIFY(content("keptTracks.csv") == content("tracks.csv"));
        QVERIFY(content("kept.npy") == content("D.npy"));
        QCOMPARE(QDir(folder).entryList(QDir::Files).size(), cache == folder ? 1 : 0);
    }
    usual.isNull() ? qunsetenv("FAINTLINE_CACHE") : qputenv("FAINTLINE_CACHE", usual);
}

void tst_cli::isTheLibrary()
{
    std::vector<float> statistic;
    const auto analysis = inLibrary("line.wav", statistic);
    writeEvents(*analysis, pathOf("library.csv"));
    writeTracks(*analysis, pathOf("libraryTracks.csv"));
    QCOMPARE(content("library.csv"), content("events.csv"));
    QCOMPARE(content("libraryTracks.csv"), content("tracks.csv"));
    QCOMPARE(statistic, readNumPy(pathOf("D.npy")).values);
    // Noise is explained as the followed line is.
    const Explanation noise = explain(*analysis, 18.0, {400.0});
    QVERIFY(!noise.isTracked);
    QVERIFY(std::abs(noise.statistic - static_cast<double>(statistic[71 * 501 + 400])) < 1e-3);
    QVERIFY(contains(errorOf([&] { explain(*analysis, 99.0, {100.0}); }), "time 99 s: must lie in 0.25 … 29.75 s"));
    QVERIFY(contains(errorOf([&] { explain(*analysis, NAN, {100.0}); }), "time nan s: must lie in"));
    QVERIFY(contains(errorOf([&] { explain(*analysis, 9.0, {NAN}); }), "frequency nan: must be a number"));
}

void tst_cli::explainsItsTerms()
{
    const Outcome told = run(m_folder, QStringList{"explain", "line.wav", "--time", "18", "--frequency", "212", "--json"} + settings);
    QCOMPARE(told.err, QByteArray());
    QCOMPARE(told.code, 0);
    const Json json = parseJson(told.out.toStdString(), "explain");
    const auto statistic = json["statistic"].get<double>();
    QCOMPARE(json["tracked"].get<bool>(), true);
    double sum = 0.0;
    for (const Json &step : json["steps"]) {
        sum += step["llr"].get<double>() + step["ln_transition"].get<double>() + step["lnK"].get<double>();
        QVERIFY(std::abs(step["sum"].get<double>() - sum) < 1e-6);
    }
    QVERIFY(std::abs(sum - statistic) < 1e-6);
    QCOMPARE(json["steps"].front()["lnK"].get<double>(), 0.0); // where the path was reset, nothing is carried over
    QCOMPARE(json["steps"].front()["ln_transition"].get<double>(), 0.0);
    QCOMPARE(json["steps"].back()["t"].get<double>(), json["time"].get<double>());
    QCOMPARE(json["margin"].get<double>(), statistic - json["threshold"].get<double>());

    const NumPyArray D = readNumPy(pathOf("D.npy"));
    const auto frame = static_cast<std::size_t>(std::llround((json["time"].get<double>() - 0.25) / 0.25));
    const auto bin = static_cast<std::size_t>(std::llround(json["position"][0].get<double>()));
    const auto shown = static_cast<double>(D.values[frame * 501 + bin]);
    QVERIFY2(std::abs(shown - statistic) < 1e-3, qPrintable(QString("D.npy %1, explained %2").arg(shown).arg(statistic)));
    QVERIFY(std::abs(shown - json["displayed"].get<double>()) < 1e-5);
}

void tst_cli::comparesTwoSettings()
{
    const QStringList options{"compare", "line.wav", "--set-b", "detector.kind=energy", "--set-b", "decide.thresholdNats=500"};
    const Outcome one = run(m_folder, options + QStringList{"--threads", "1", "--events", "compared1.csv", "--difference", "compared1.npy"} + settings);
    QCOMPARE(one.err, QByteArray());
    QCOMPARE(one.code, 0);
    QVERIFY2(one.out.contains("  detector.kind: smd in A, energy in B\n"), one.out.data());
    QVERIFY2(one.out.contains("only in A: 1"), one.out.data());
    QVERIFY(content("compared1.csv").startsWith("in,event_a,event_b,t_onset,"));
    QVERIFY(content("compared1.csv").contains("\nA,1,,"));
    const NumPyArray difference = readNumPy(pathOf("compared1.npy"));
    QCOMPARE(difference.shape, (std::vector<Index>{119, 501}));

    const Outcome two = run(m_folder, options + QStringList{"--threads", "2", "--events", "compared2.csv", "--difference", "compared2.npy"} + settings);
    QCOMPARE(two.out, one.out);
    QVERIFY(content("compared2.csv") == content("compared1.csv"));
    QVERIFY(content("compared2.npy") == content("compared1.npy"));

    // The same on both sides: everything in both, no difference.
    const Outcome same = run(m_folder, QStringList{"compare", "line.wav", "--difference", "same.npy"} + settings);
    QVERIFY2(same.out.contains("their settings are the same\nin both: 1, only in A: 0, only in B: 0\n"), same.out.data());
    for (const float value : readNumPy(pathOf("same.npy")).values)
        QCOMPARE(value, 0.0f);
}

void tst_cli::framesInPlaceOfARecording()
{
    // Exponential noise with a target that climbs a cell a frame from cell 5 on.
    Random random(1, 1);
    std::vector<float> y(40 * 50);
    for (float &value : y)
        value = static_cast<float>(random.exponential());
    for (std::size_t frame = 10; frame < 30; ++frame)
        y[frame * 50 + frame + 5] += 9.0f;
    writeArray(pathOf("y.npy"), {40, 50}, y);
    writeBytes(pathOf("grid.json"), R"({"axes": [{"name": "range", "unit": "m", "first": 1000, "step": 10}], "time": {"first": 5, "step": 2}})");
    writeBytes(pathOf("model.json"), R"({"axes": [{"cells": 50, "rates": [-1, 0, 1], "rateChange": [1]}], "likelihood": {"kind": "linear"},
        "reset": {"law": "fixed", "lnK": -1.4}})");
    const Outcome found = run(m_folder, {"detect", "--frames", "y.npy", "--grid", "grid.json", "--model", "model.json", "--set",
                                         "decide.thresholdNats=20", "--events", "target.csv", "--tracks", "target.json", "--statistic", "T.npy"});
    QCOMPARE(found.err, QByteArray());
    QCOMPARE(found.code, 0);
    const auto events = numbersOf(content("target.csv"));
    QCOMPARE(events.size(), std::size_t(1));
    const double detect = events[0][2]; // frame (t - 5)/2, cell frame + 5
    QVERIFY(detect >= 25.0 && detect < 65.0);
    QVERIFY2(std::abs(events[0][4] - (1000.0 + 10.0 * ((detect - 5.0) / 2.0 + 5.0))) <= 20.0, content("target.csv").data());
    QVERIFY2(std::abs(events[0][5] - 5.0) < 0.6, content("target.csv").data()); // 10 m in 2 s
    QCOMPARE(readNumPy(pathOf("T.npy")).shape, (std::vector<Index>{40, 50}));
}

void tst_cli::pingsFromAScene()
{
    writeBytes(pathOf("pings.json"), R"({"kind": "pings", "pings": 30, "rangeCells": 90, "beams": 8, "targets": [{"snrDb": 12, "rangeMetres": 3200,
        "bearingDegrees": 315, "appearPing": 4, "legs": [{"rangeCellsPerPing": 2, "beamsPerPing": 0.2}]}]})");
    const Outcome info = run(m_folder, {"info", "pings.json"});
    QVERIFY2(info.out.contains("range         90 cells of 10 m, 3000 … 3890 m") && info.out.contains("target 1      12 dB, constant, pings 4 … 29"),
             info.out.data());
    QCOMPARE(run(m_folder, {"simulate", "pings.json", "--out", "P.npy", "--truth", "P.json"}).code, 0);
    QCOMPARE(readNumPy(pathOf("P.npy")).shape, (std::vector<Index>{30, 90, 8}));
    const Json truth = parseJson(content("P.json").toStdString(), "truth");
    QCOMPARE(truth["targets"][0]["cell"].size(), std::size_t(26));
    // From the scene and from the frames written: the same events, byte for byte.
    const QStringList settings{"--preset", "sonar", "--set", "decide.thresholdNats=20"};
    QCOMPARE(run(m_folder, QStringList{"detect", "pings.json", "--events", "a.csv"} + settings).code, 0);
    QCOMPARE(run(m_folder, QStringList{"detect", "--frames", "P.npy", "--grid", "P.grid.json", "--events", "b.csv"} + settings).code, 0);
    QVERIFY(content("a.csv").startsWith("event,t_onset,t_detect,t_end,range,bearing,drift_hz_per_s,statistic,confirmed,open,range_per_s,bearing_per_s\n"));
    QCOMPARE(content("a.csv"), content("b.csv"));
    bool isFound = false;
    for (const auto &event : numbersOf(content("a.csv"))) // 20 m and 9° in 40 s
        isFound = isFound || (event[8] == 1.0 && std::abs(event[10] - 0.5) < 0.1 && std::abs(event[11] - 0.225) < 0.1);
    QVERIFY2(isFound, content("a.csv").data());
    // The same cell is explained of the scene and of its frames.
    const QStringList cell{"--time", "960", "--range", "3400", "--bearing", "0", "--json"};
    const Outcome why = run(m_folder, QStringList{"explain", "pings.json"} + cell + settings);
    QCOMPARE(why.err, QByteArray());
    const Json json = parseJson(why.out.toStdString(), "explain");
    double sum = json["offset"].get<double>();
    for (const Json &step : json["steps"])
        sum += step["llr"].get<double>() + step["ln_transition"].get<double>() + step["lnK"].get<double>();
    QVERIFY(std::abs(sum - json["statistic"].get<double>()) < 1e-6);
    QVERIFY(std::abs(sum - json["displayed"].get<double>()) < 1e-3);
    QCOMPARE(json["position"].size(), std::size_t(2));
    const Outcome unnamed = run(m_folder, QStringList{"explain", "pings.json", "--time", "960", "--frequency", "3400"} + settings);
    QCOMPARE(unnamed.code, 2);
    QVERIFY(unnamed.err.contains("--range and --bearing"));
    // Beside it, the conventional detector.
    QCOMPARE(run(m_folder, QStringList{"detect", "pings.json", "--conventional", "c.csv"} + settings).code, 0);
    QVERIFY(content("c.csv").startsWith("event,t_onset,t_detect,t_end,range,bearing,"));
    QVERIFY(content("c.csv").count('\n') >= 2); // 12 dB show in a ping by themselves

    const Outcome wrong = run(m_folder, {"simulate", "pings.json", "--out", "P.wav"});
    QCOMPARE(wrong.code, 2);
    QVERIFY(wrong.err.contains("P.wav: pings are written as frames"));
}

void tst_cli::billonsVectors_data()
{
    QTest::addColumn<QByteArray>("axis");
    QTest::addColumn<double>("lnK");
    QTest::addColumn<int>("column"); ///< of outputs.csv
    QTest::addColumn<int>("states");
    QTest::newRow("stable, K = 0.92") << QByteArray(R"("rates": [0], "rateChange": [1])") << std::log(0.92) << 4 << 16;
    QTest::newRow("5 slopes, K = 2") << QByteArray(R"("rates": [-2, -1, 0, 1, 2], "rateChange": [0.3333333333333333, 0.3333333333333333])")
                                     << std::log(2.0) << 5 << 80;
}

void tst_cli::billonsVectors()
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
        y.push_back(static_cast<float>(row[2]));
    writeArray(pathOf("billon.npy"), {12, 16}, y);
    writeBytes(pathOf("billon.json"), R"({"axes": [{"name": "frequency", "cells": 16, )" + axis
                   + R"(}], "likelihood": {"kind": "rice", "r0": 0.5}, "reset": {"law": "fixed", "lnK": )" + QByteArray::number(lnK, 'g', 17) + "}}");
    const Outcome done = run(m_folder, {"statistic", "--frames", "billon.npy", "--model", "billon.json", "--out", "L.npy", "--projected", "P.npy"});
    QCOMPARE(done.err, QByteArray());
    QCOMPARE(done.code, 0);
    const NumPyArray L = readNumPy(pathOf("L.npy"));
    const NumPyArray projected = readNumPy(pathOf("P.npy"));
    QCOMPARE(L.shape, (std::vector<Index>{12, states / 16, 16}));
    QCOMPARE(projected.shape, (std::vector<Index>{12, 16}));
    for (std::size_t i = 0; i < expected.size(); ++i) {
        // The vectors' ln Λ starts from ln P_n = -ln N; L = ln NΛ.
        const double wanted = expected[i][static_cast<std::size_t>(column)] + std::log(states);
        QVERIFY2(std::abs(static_cast<double>(projected.values[i]) - wanted) < 1e-5,
                 qPrintable(QString("frame %1, bin %2: %3, vector %4").arg(i / 16).arg(i % 16).arg(double(projected.values[i])).arg(wanted)));
        float largest = -INFINITY;
        for (std::size_t rate = 0; rate < static_cast<std::size_t>(states / 16); ++rate)
            largest = std::max(largest, L.values[(i / 16 * static_cast<std::size_t>(states / 16) + rate) * 16 + i % 16]);
        QCOMPARE(projected.values[i], largest);
    }
}

void tst_cli::parsonsVectors()
{
    const auto input = numbersOf(shared("parsons/input.csv"));
    const auto expected = numbersOf(shared("parsons/expected_non.csv"));
    if (input.empty() || expected.empty())
        QSKIP("skipped: no ../shared");
    // Axes in the vectors' order of a state: range, bearing.
    std::vector<float> y(6 * 24 * 6);
    for (const auto &row : input)
        for (std::size_t range = 0; range < 24; ++range)
            y[static_cast<std::size_t>(row[0]) * 144 + range * 6 + static_cast<std::size_t>(row[1])] = static_cast<float>(row[2 + range]);
    writeArray(pathOf("pings.npy"), {6, 24, 6}, y);
    writeBytes(pathOf("parsons.json"), R"({"axes": [{"name": "range", "cells": 24, "rates": [-2, -1, 0, 1, 2], "rateChange": [1], "round": "trunc"},
        {"name": "bearing", "cells": 6, "cyclic": true, "rates": [-1, 0, 1], "rateChange": [1], "round": "trunc"}],
        "likelihood": {"kind": "linear"}, "reset": {"law": "mean"}})");
    const Outcome done =
        run(m_folder, {"statistic", "--frames", "pings.npy", "--model", "parsons.json", "--out", "LP.npy", "--log", "K.csv"});
    QCOMPARE(done.err, QByteArray());
    QCOMPARE(done.code, 0);
    const NumPyArray L = readNumPy(pathOf("LP.npy"));
    QCOMPARE(L.shape, (std::vector<Index>{6, 5, 3, 24, 6}));
    QVERIFY(content("K.csv").startsWith("frame,lnK,reset_fraction,max_statistic\n"));
    const auto log = numbersOf(content("K.csv"));
    QCOMPARE(log.size(), std::size_t(6));
    std::vector<double> largest(6, -INFINITY);
    for (const auto &row : expected) { // ping, K, reset, r, b, u, v, lnL
        const auto ping = static_cast<std::size_t>(row[0]);
        const auto rate = static_cast<std::size_t>((row[5] + 2.0) * 3.0 + row[6] + 1.0);
        const auto cell = static_cast<std::size_t>(row[3] * 6.0 + row[4]);
        const auto found = static_cast<double>(L.values[(ping * 15 + rate) * 144 + cell]);
        QVERIFY2(std::abs(found - row[7]) < 1e-4, qPrintable(QString("ping %1: %2, vector %3").arg(ping).arg(found).arg(row[7])));
        QVERIFY(std::abs(log[ping][1] - row[1]) < 1e-5);
        QVERIFY(std::abs(log[ping][2] - row[2]) < 1e-9);
        largest[ping] = std::max(largest[ping], row[7]);
    }
    for (std::size_t ping = 0; ping < 6; ++ping)
        QVERIFY(std::abs(log[ping][3] - largest[ping]) < 1e-4);
}

void tst_cli::lnLambdaByEye()
{
    // Two cells, nothing moves, λ = y, ln K = -1: L = y + max(L - 1, 0).
    writeArray(pathOf("eye.npy"), {3, 2}, {0.5f, 3.0f, 1.0f, 0.0f, 0.25f, 2.0f});
    writeBytes(pathOf("eye.json"), R"({"axes": [{"cells": 2}], "likelihood": {"kind": "linear"}, "reset": {"law": "fixed", "lnK": -1}})");
    QCOMPARE(run(m_folder, {"statistic", "--frames", "eye.npy", "--model", "eye.json", "--out", "eyeL.npy", "--log", "eye.csv"}).code, 0);
    QCOMPARE(readNumPy(pathOf("eyeL.npy")).values, (std::vector<float>{0.5f, 3.0f, 1.0f, 2.0f, 0.25f, 3.0f}));
    QCOMPARE(content("eye.csv"), QByteArray("frame,lnK,reset_fraction,max_statistic\n0,-1,1,3\n1,-1,0.5,2\n2,-1,0.5,3\n"));

    // A cell that nobody can have come from: rate 1 from the lowest cell, and no reset.
    writeBytes(pathOf("none.json"), R"({"axes": [{"cells": 2, "rates": [1], "rateChange": [1]}], "likelihood": {"kind": "linear"},
        "reset": {"law": "none"}})");
    QCOMPARE(run(m_folder, {"statistic", "--frames", "eye.npy", "--model", "none.json", "--out", "noneL.npy"}).code, 0);
    QCOMPARE(readNumPy(pathOf("noneL.npy")).values, (std::vector<float>{0.5f, 3.0f, -INFINITY, 0.5f, -INFINITY, -INFINITY}));

    // All paths counted: with one state it is the same sum.
    writeArray(pathOf("one.npy"), {3, 1}, {0.5f, 3.0f, 1.0f});
    writeBytes(pathOf("sum.json"), R"({"axes": [{"cells": 1}], "likelihood": {"kind": "linear"}, "reset": {"law": "none", "semiring": "sum"}})");
    QCOMPARE(run(m_folder, {"statistic", "--frames", "one.npy", "--model", "sum.json", "--out", "sumL.npy"}).code, 0);
    QCOMPARE(readNumPy(pathOf("sumL.npy")).values, (std::vector<float>{0.5f, 3.5f, 4.5f}));
}

void tst_cli::sequentialByEye()
{
    // λ = y, two cells, a target that stays: Λ = ½ (e^Σy₀ + e^Σy₁), ln 99 = 4.595 is passed at the third stage by cell 1.
    writeArray(pathOf("eye3.npy"), {4, 2}, {0.5f, 2.0f, 1.0f, 2.0f, 0.0f, 2.0f, 7.0f, 7.0f});
    writeBytes(pathOf("eye3.json"), R"({"axes": [{"cells": 2}], "likelihood": {"kind": "linear"}})");
    QCOMPARE(run(m_folder, {"sequential", "--frames", "eye3.npy", "--model", "eye3.json", "--alpha", "0.01", "--beta", "0.01", "--out", "eye3.out"}).code, 0);
    const Json json = readJsonFile(pathOf("eye3.out"));
    QCOMPARE(json["decision"].get<std::string>(), std::string("H1"));
    QCOMPARE(json["stop"].get<int>(), 3);
    QCOMPARE(json["map"].dump(), std::string("[[1],[1],[1]]"));
    QVERIFY(std::abs(json["lnMapScore"].get<double>() - (6.0 - std::log(2.0))) < 1e-12);
    QCOMPARE(json["lnLambda"].size(), std::size_t(3));
    QVERIFY(std::abs(json["lnLambda"][2].get<double>() - std::log(0.5 * (std::exp(1.5) + std::exp(6.0)))) < 1e-12);

    QCOMPARE(run(m_folder, {"sequential", "--frames", "eye3.npy", "--model", "eye3.json", "--alpha", "1e-30", "--beta", "1e-30", "--out", "eye3.out"}).code, 0);
    const Json open = readJsonFile(pathOf("eye3.out"));
    QCOMPARE(open["decision"].get<std::string>(), std::string("undecided"));
    QCOMPARE(open["stop"].get<int>(), 4);
    QVERIFY(open["map"].empty() && open["lnMapScore"].is_null());
}

void tst_cli::sequentialInRadarScans()
{
    writeBytes(pathOf("scans.json"), R"({"kind": "scans", "azimuthCells": 2, "elevationCells": 2, "rangeCells": 20, "dopplerCells": 4, "snrDb": 20})");
    writeBytes(pathOf("scans.model"), R"({"axes": [{"cells": 2, "step": "uniform-admissible"}, {"cells": 2, "step": "uniform-admissible"},
        {"cells": 20, "step": "uniform-admissible"}, {"cells": 4, "integrate": true}], "likelihood": {"kind": "exponential", "snr": 100}})");
    int found = 0;
    for (const char *seed : {"1", "2", "3", "4", "5"}) {
        QCOMPARE(run(m_folder, {"simulate", "scans.json", "--seed", seed, "--out", "scans.npy", "--truth", "scans.truth"}).code, 0);
        QCOMPARE(run(m_folder, {"sequential", "--frames", "scans.npy", "--model", "scans.model", "--cutoff", "20", "--out", "scans.out"}).code, 0);
        const Json result = readJsonFile(pathOf("scans.out"));
        const Json truth = readJsonFile(pathOf("scans.truth"));
        const auto last = result["stop"].get<std::size_t>() - 1;
        found += result["decision"] == "H1" && result["map"][last] == truth["cells"][last] ? 1 : 0;
    }
    QVERIFY(found >= 4);
    const Outcome samples = run(m_folder, {"simulate", "scans.json", "--out", "scans.wav"});
    QCOMPARE(samples.code, 2);
    QVERIFY(samples.err.contains("must end in .npy"));
}

void tst_cli::sequentialInUnknownNoise()
{
    // A target that stays in cell 3 of 9, then all of it 1000 times louder: to the average it is the same, to known noise it is not.
    std::vector<float> y(3 * 9, 1.0f);
    for (const std::size_t stage : {0, 1, 2})
        y[stage * 9 + 3] = 12.0f;
    writeArray(pathOf("quiet.npy"), {3, 9}, y);
    for (float &value : y)
        value *= 1024.0f;
    writeArray(pathOf("loud.npy"), {3, 9}, y);
    writeBytes(pathOf("nine.json"), R"({"axes": [{"cells": 9}], "likelihood": {"kind": "exponential", "snr": 10}})");
    const auto lnLambda = [this](const char *frames, const char *cells) {
        const QStringList options{"--model", "nine.json", "--alpha", "1e-9", "--beta", "1e-9", "--out", "nine.out"};
        const Outcome outcome = run(m_folder, QStringList{"sequential", "--frames", frames, "--average", cells} + options);
        return outcome.code == 0 ? readJsonFile(pathOf("nine.out"))["lnLambda"].dump() : std::string(outcome.err.constData());
    };
    QCOMPARE(lnLambda("loud.npy", "4"), lnLambda("quiet.npy", "4"));
    QVERIFY(lnLambda("loud.npy", "0") != lnLambda("quiet.npy", "0"));
    // One stage by hand: the target's cell has t = 12, its neighbours 1/(1 + 11/4) or 1.
    const auto ratio = [](double t) { return std::pow((1.0 + t / 4.0) / (1.0 + t / 44.0), 5.0) / 11.0; };
    const double near = ratio(1.0 / (1.0 + 11.0 / 4.0));
    // Rows end: the four nearest of cells 0 and 1 are those within 0 … 4, which has the target.
    const double first = std::log((ratio(12.0) + 5.0 * near + 3.0 * ratio(1.0)) / 9.0);
    const Json quiet = parseJson(lnLambda("quiet.npy", "4"), "quiet");
    QVERIFY2(std::abs(quiet[0].get<double>() - first) < 1e-4, qPrintable(QString::number(quiet[0].get<double>() - first)));
}

void tst_cli::sequentialInARecording()
{
    // The line of the scene stands from 8 s to 23 s at 210 Hz: noise before it, a signal from it on.
    const QStringList part{"sequential", "line.wav", "--set", "spectrogram.windowSeconds=0.5", "--low", "195", "--high", "225", "--out", "part.out"};
    QCOMPARE(run(m_folder, part + QStringList{"--from", "0", "--to", "8"}).code, 0);
    QCOMPARE(readJsonFile(pathOf("part.out"))["decision"].get<std::string>(), std::string("H0"));
    QCOMPARE(run(m_folder, part + QStringList{"--from", "10", "--to", "20"}).code, 0);
    QCOMPARE(readJsonFile(pathOf("part.out"))["decision"].get<std::string>(), std::string("H1"));
}

void tst_cli::sequentialMistakes_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("message");
    const QStringList frames{"--frames", "eye3.npy"};
    const QStringList model{"--model", "eye3.json"};
    QTest::newRow("nothing to look at") << model << "takes either a recording or --frames";
    QTest::newRow("no model") << frames << "needs --model";
    QTest::newRow("α of 0") << frames + model + QStringList{"--alpha", "0"} << "sequential.falseAlarm = 0: must lie in";
    QTest::newRow("a coin") << frames + model + QStringList{"--alpha", "0.5", "--beta", "0.5"} << "must stay below 1";
    QTest::newRow("negative cut-off") << frames + model + QStringList{"--cutoff", "-1"} << "sequential.cutOffStage = -1";
    QTest::newRow("nothing to average") << frames + model + QStringList{"--average", "1"} << "--average: needs an exponential likelihood";
    QTest::newRow("other cells") << frames + QStringList{"--model", "scans.model"} << "has 2 × 2 × 20 × 4 cells, but the frames of eye3.npy have 2";
}

void tst_cli::sequentialMistakes()
{
    QFETCH(QStringList, arguments);
    QFETCH(QString, message);
    const Outcome outcome = run(m_folder, QStringList{"sequential", "--out", "never.json"} + arguments);
    QCOMPARE(outcome.code, 2);
    QVERIFY2(QString::fromUtf8(outcome.err).contains(message), outcome.err.constData());
    QCOMPARE(outcome.err.count('\n'), 1);
    QVERIFY(!QFile::exists(path("never.json")));
}

void tst_cli::mistakes_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<QString>("message");
    const auto row = [](const char *name, const QStringList &arguments, const char *message) {
        QTest::newRow(name) << arguments << QString::fromUtf8(message);
    };
    row("nothing asked", {}, "command line: A subcommand is required");
    row("no such command", {"dtect"}, "command line: ");
    row("no such option", {"detect", "line.wav", "--summery"}, "command line: The following argument was not expected: --summery");
    row("no number", {"detect", "line.wav", "--summary", "--from", "soon"}, "command line: Could not convert: --from = soon");
    row("no threads", {"--threads", "0", "describe"}, "command line: --threads");
    row("no such file", {"info", "none.wav"}, "none.wav: there is no such file");
    row("a folder", {"info", "."}, ".: is a folder");
    row("a text", {"info", "truth.json"}, "");
    row("unknown setting", {"describe", "smd.k"}, "smd.k: is no setting; the nearest is smd.lnK");
    row("misspelt setting", {"detect", "line.wav", "--summary", "--set", "smd.thresold=3"}, "smd.thresold: is no setting; the nearest is ");
    row("no assignment", {"detect", "line.wav", "--summary", "--set", "smd.lnK"}, "--set smd.lnK: must be name=value");
    row("setting out of range", {"detect", "line.wav", "--summary", "--set", "spectrogram.windowSeconds=-1"},
        "spectrogram.windowSeconds = -1: must lie in 0 … 1e+06 s");
    row("setting that is no number", {"detect", "line.wav", "--summary", "--set", "smd.lnK=nan"}, "smd.lnK = nan: must lie in -100 … 100 nat");
    row("settings that disagree", {"detect", "line.wav", "--summary", "--set", "model.slopeChange=0.5"}, "model.slopeChange = 0.5: h(0) + 2·");
    row("slopes upside down", {"detect", "line.wav", "--summary", "--set", "model.lowestSlope=3"}, "model.lowestSlope = 3: must not exceed");
    row("no output", {"detect", "line.wav"}, "detect: says nothing without at least one of --events");
    row("comparison without a recording", {"compare"}, "command line: FILE is required");
    row("comparison in another format", {"compare", "line.wav", "--events", "e.txt"}, "e.txt: the kind of file is told by its extension: .csv");
    row("comparison with a misspelt setting", {"compare", "line.wav", "--set-b", "smd.thresold=3"}, "smd.thresold: is no setting");
    row("no input", {"detect", "--summary"}, "detect: needs a recording, or --frames");
    row("two inputs", {"detect", "line.wav", "--frames", "y.npy", "--summary"}, "detect: takes a recording or --frames, not both");
    row("unknown kind of events", {"detect", "line.wav", "--events", "e.xml"}, "e.xml: the kind of file is told by its extension");
    row("unknown kind of tracks", {"detect", "line.wav", "--tracks", "t.txt"}, "t.txt: the kind of file is told by its extension");
    row("no such folder", {"detect", "line.wav", "--statistic", "no/D.npy"}, "no/D.npy: cannot be written: No such file or directory");
    row("channel", {"detect", "line.wav", "--summary", "--channel", "1"}, "selection.channel = 1: the recording has 1 channel(s)");
    row("negative channel", {"detect", "line.wav", "--summary", "--channel", "-1"}, "command line: --channel");
    row("one channel as I/Q", {"detect", "line.wav", "--summary", "--iq"}, "line.wav: has 1 channel(s), but I/Q needs them in pairs");
    row("behind the end", {"detect", "line.wav", "--summary", "--from", "31"}, "selection.fromSeconds = 31: must lie before");
    row("before the beginning", {"detect", "line.wav", "--summary", "--from", "-1"}, "selection.fromSeconds = -1: must lie in 0");
    row("band upside down", {"detect", "line.wav", "--summary", "--low", "50", "--high", "20"}, "selection.lowHz = 50: must not lie above");
    row("band that is no number", {"detect", "line.wav", "--summary", "--low", "nan"}, "selection.lowHz = nan: must lie in");
    row("longer than the recording", {"detect", "line.wav", "--summary", "--set", "spectrogram.windowSeconds=31"}, "shorter than one window of 31 s");
    row("unknown preset", {"detect", "line.wav", "--summary", "--preset", "x"}, "preset x: is not known; there are lines, billon");
    row("no session", {"detect", "line.wav", "--summary", "--session", "line.wav"}, "line.wav: is not valid JSON");
    row("no scene", {"simulate", "line.wav", "--out", "x.wav"}, "line.wav: is not valid JSON");
    row("no kind of recording", {"simulate", "scene.json", "--out", "x.xyz"}, "x.xyz: has no extension that says what to write");
    row("negative seed", {"simulate", "scene.json", "--out", "x.wav", "--seed", "-1"}, "command line: --seed");
    row("no model", {"statistic", "--frames", "none.npy", "--model", "m.json", "--out", "x.npy"}, "none.npy: cannot be opened");
}

void tst_cli::mistakes()
{
    QFETCH(QStringList, arguments);
    QFETCH(QString, message);
    const Outcome told = run(m_folder, arguments);
    QCOMPARE(told.code, 2);
    QCOMPARE(told.out, QByteArray());
    QVERIFY2(told.err.startsWith("error: ") && told.err.endsWith('\n') && told.err.count('\n') == 1, told.err.data());
    QVERIFY2(QString::fromUtf8(told.err).contains(message), told.err.data());
    QVERIFY2(told.err.size() < 500, told.err.data());
    for (const char *name : {"e.xml", "t.txt", "x.wav", "x.xyz", "x.npy"})
        QVERIFY2(!QFile::exists(path(name)), name);
    QVERIFY(QDir(m_folder.path()).entryList({"*.part"}, QDir::Files | QDir::Hidden).isEmpty());
}

void tst_cli::mistakesInFrames_data()
{
    QTest::addColumn<QByteArray>("model");
    QTest::addColumn<QString>("message");
    QTest::newRow("other cells") << QByteArray(R"({"axes": [{"cells": 3}], "likelihood": {"kind": "linear"}})") << "do not fit the frames of two.npy";
    QTest::newRow("other axes") << QByteArray(R"({"axes": [{"cells": 1}, {"cells": 2}], "likelihood": {"kind": "linear"}})") << "do not fit the frames of two.npy";
    QTest::newRow("misspelt key") << QByteArray(R"({"axis": []})") << "m.json.axis: is not known";
    QTest::newRow("no law") << QByteArray(R"({"axes": [{"cells": 2, "rateChange": [0.9]}], "likelihood": {"kind": "linear"}})") << "axes[0].rateChange: h(0)";
    QTest::newRow("r0 of 0") << QByteArray(R"({"axes": [{"cells": 2}], "likelihood": {"kind": "rice", "r0": 0}})") << "m.json: likelihood.r0 = 0: must be";
}

void tst_cli::mistakesInFrames()
{
    QFETCH(QByteArray, model);
    QFETCH(QString, message);
    writeArray(pathOf("two.npy"), {3, 2}, {1, 2, 3, 4, 5, 6});
    writeBytes(pathOf("m.json"), model);
    const Outcome told = run(m_folder, {"statistic", "--frames", "two.npy", "--model", "m.json", "--out", "x.npy"});
    QCOMPARE(told.code, 2);
    QVERIFY2(told.err.startsWith("error: m.json") && told.err.count('\n') == 1, told.err.data());
    QVERIFY2(QString::fromUtf8(told.err).contains(message), told.err.data());
    QVERIFY(!QFile::exists(path("x.npy")));
}

void tst_cli::fullDiskIsAFailure()
{
    // No file may grow beyond 1000 bytes: what a full disk does, the machine's fault and not the user's.
    for (const QString name : {"full.wav", "full.caf", "full.flac", "full.sigmf-meta"}) {
        const Outcome told = run(m_folder, {"simulate", "scene.json", "--out", name}, [] {
            std::signal(SIGXFSZ, SIG_IGN);
            const rlimit limit{1000, 1000};
            setrlimit(RLIMIT_FSIZE, &limit);
        });
        QVERIFY2(told.code == 1, told.err.data());
        QVERIFY2(told.err.startsWith("error: full") && told.err.count('\n') == 1, told.err.data());
    }
    QVERIFY(QDir(m_folder.path()).entryList({"full*"}, QDir::Files | QDir::Hidden).isEmpty());
}

void tst_cli::interruptLeavesNothing_data()
{
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("signal");
    QTest::newRow("simulate") << QStringList{"simulate", "endless.json", "--out", "endless.w64"} << SIGINT;
    QTest::newRow("detect") << QStringList{"detect", "endless.json", "--statistic", "endless.npy", "--events", "endless.csv"} << SIGINT;
    QTest::newRow("terminated") << QStringList{"detect", "endless.json", "--statistic", "endless.npy"} << SIGTERM;
}

void tst_cli::interruptLeavesNothing()
{
    QFETCH(QStringList, arguments);
    QFETCH(int, signal);
    // A day of noise: more than any machine makes before it is told to stop.
    writeBytes(pathOf("endless.json"), R"({"sampleRateHz": 8000, "durationSeconds": 86400})");
    QProcess process;
    process.setWorkingDirectory(m_folder.path());
    process.start(program, arguments);
    QVERIFY(process.waitForStarted(patience));
    const auto halfWritten = [&] { return QDir(m_folder.path()).entryList({"endless*.part", ".endless*"}, QDir::Files | QDir::Hidden); };
    QTRY_VERIFY_WITH_TIMEOUT(!halfWritten().isEmpty() || process.state() == QProcess::NotRunning, patience);
    QVERIFY2(process.state() == QProcess::Running, process.readAllStandardError().data());
    QCOMPARE(::kill(static_cast<pid_t>(process.processId()), signal), 0);
    QVERIFY(process.waitForFinished(patience));
    QCOMPARE(process.exitStatus(), QProcess::NormalExit);
    QCOMPARE(process.exitCode(), 1);
    QCOMPARE(process.readAllStandardError(), QByteArray("error: interrupted: nothing half-written is left\n"));
    QCOMPARE(process.readAllStandardOutput(), QByteArray());
    QCOMPARE(QDir(m_folder.path()).entryList({"endless*", ".endless*"}, QDir::Files | QDir::Hidden), QStringList{"endless.json"});
}

void tst_cli::oddRecordings_data()
{
    QTest::addColumn<QByteArray>("bytes");
    QTest::addColumn<bool>("isRefused");
    std::vector<float> samples = someNoise(8000);
    const QByteArray sound = wav(1000, 1, samples);
    QTest::newRow("sound") << sound << false;
    QTest::newRow("empty") << QByteArray() << true;
    QTest::newRow("text") << QByteArray("This is no recording.\n").repeated(100) << true;
    QTest::newRow("only a header") << sound.left(44) << true;
    QTest::newRow("half a header") << sound.left(30) << true;
    QTest::newRow("cut off") << sound.left(44 + 4 * 6000 + 3) << false;
    QTest::newRow("0 Hz") << wav(0, 1, samples) << true;
    QTest::newRow("4 GHz") << wav(4294967295u, 1, samples) << true;
    QTest::newRow("no channel") << wav(1000, 0, samples) << true;
    QTest::newRow("255 channels") << wav(1000, 255, someNoise(255 * 1500)) << false;
    QTest::newRow("one sample") << wav(1000, 1, {0.5f}) << true;
    QTest::newRow("less than a window") << wav(1000, 1, someNoise(499)) << true;
    QTest::newRow("one window") << wav(1000, 1, someNoise(500)) << false;
    QTest::newRow("constant") << wav(1000, 1, std::vector<float>(8000, 0.5f)) << false;
    QTest::newRow("silence") << wav(1000, 1, std::vector<float>(8000, 0.0f)) << false;
    QTest::newRow("hardly anything") << wav(1000, 1, std::vector<float>(8000, 1e-42f)) << false;
    std::vector<float> loud = samples;
    for (float &sample : loud)
        sample *= 1e37f;
    QTest::newRow("far too loud") << wav(1000, 1, loud) << false;
    QTest::newRow("no number at all") << wav(1000, 1, std::vector<float>(8000, NAN)) << false;
}

void tst_cli::oddRecordings()
{
    QFETCH(QByteArray, bytes);
    QFETCH(bool, isRefused);
    writeBytes(pathOf("odd.wav"), bytes);
    if (isRefused) {
        const Outcome told = run(m_folder, QStringList{"detect", "odd.wav", "--events", "odd.csv", "--statistic", "odd.npy"} + settings);
        QCOMPARE(told.code, 2);
        QCOMPARE(told.out, QByteArray());
        QVERIFY2(told.err.startsWith("error: ") && told.err.count('\n') == 1, told.err.data());
        QVERIFY(QDir(m_folder.path()).entryList({"odd.csv*", "odd.npy*"}, QDir::Files | QDir::Hidden).isEmpty());
        return;
    }
    // The library, which is the program (isTheLibrary): it calibrates once for all of them.
    std::vector<float> statistic;
    const auto analysis = inLibrary("odd.wav", statistic);
    QVERIFY(std::ranges::all_of(statistic, [](float value) { return std::isfinite(value); }));
    QVERIFY(std::isfinite(analysis->threshold));
    writeEvents(*analysis, pathOf("odd.csv"));
    writeTracks(*analysis, pathOf("oddTracks.csv"));
    for (const char *name : {"odd.csv", "oddTracks.csv"}) {
        const QByteArray text = content(name);
        QVERIFY2(text.count('\n') == 1 || !numbersOf(text).empty(), text.data());
        QVERIFY2(!text.contains("nan") && !text.contains("inf"), text.data());
        QFile::remove(path(name));
    }
}

void tst_cli::samplesThatAreNoNumbers()
{
    std::vector<float> samples = someNoise(8000);
    std::fill_n(samples.begin() + 3000, 400, NAN);
    samples[5] = INFINITY;
    writeBytes(pathOf("nan.wav"), wav(1000, 1, samples));
    const Outcome done = run(m_folder, QStringList{"detect", "nan.wav", "--events", "nan.csv", "--statistic", "nan.npy"} + settings);
    QCOMPARE(done.err, QByteArray());
    QCOMPARE(done.code, 0);
    const QByteArray events = content("nan.csv");
    QVERIFY2(events.count('\n') == 1 || !numbersOf(events).empty(), events.data());
    QVERIFY2(!events.contains("nan") && !events.contains("inf"), events.data());
    QVERIFY(std::ranges::all_of(readNumPy(pathOf("nan.npy")).values, [](float value) { return std::isfinite(value); }));
}

QTEST_GUILESS_MAIN(tst_cli)
#include "tst_cli.moc"
