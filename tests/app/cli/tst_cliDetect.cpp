#include "analyse/analyse.h"
#include "app/cli/CommandLineTest.h"
#include "base/json.h"
#include "exchange/writeEvents.h"
#include "inspect/explain.h"
#include "signal/formats/NumPy.h"
#include "signal/openRecording.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// detect and explain, on a line, on frames, on pings and on what hardly is a recording: the same bytes on however many
/// threads.
class tst_cliDetect : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        simulateLine();
        const Outcome found = run(QStringList{"detect", "line.wav", "--threads", "1", "--events", "events.csv",
                                              "--tracks", "tracks.csv", "--statistic", "D.npy"}
                                  + lineSettings);
        QCOMPARE(found.err, QByteArray());
        QCOMPARE(found.code, 0);
        QCOMPARE(found.out, QByteArray());
    }

    void findsTheLine();
    void statisticHasTheFramesShape();
    void threadsChangeNoByte();
    void saysWhatItFoundWhereNothingIsWritten();
    void theBandMayHaveOneEdge();
    void printsTheEventsAsJson();
    void keptCalibrationsChangeNoByte();
    void aFolderOfCalibrationsCanBeCopied();
    void isTheLibrary();
    void explainsItsTerms();
    void slopesInHertzAreTheSame();
    void framesInPlaceOfARecording();
    void pingsFromAScene();
    void oddRecordings_data();
    void oddRecordings();
    void samplesThatAreNoNumbers();
    void passesOnTheRecordingsNotes();
};

namespace {

std::shared_ptr<const Analysis> inLibrary(const std::string &path, std::vector<float> &statistic)
{
    AnalysisSettings own;
    setSetting(own, "spectrogram.windowSeconds", "0.5");
    setSetting(own, "decide.falseAlarmsPerHour", "2");
    const StatisticSink sink = [&](Index, std::span<const float> values) {
        statistic.insert(statistic.end(), values.begin(), values.end());
    };
    return analyse(openRecording(path), own, {.statistic = sink});
}

/// A WAV file of float samples, its header by hand, so that it may lie.
QByteArray wav(quint32 rate, quint16 channels, const std::vector<float> &samples)
{
    const auto number = [](auto value) { return QByteArray(reinterpret_cast<const char *>(&value), sizeof value); };
    const QByteArray data(reinterpret_cast<const char *>(samples.data()), qsizetype(4 * samples.size()));
    return "RIFF" + number(quint32(36 + data.size())) + "WAVEfmt " + number(quint32(16)) + number(quint16(3))
           + number(channels) + number(rate) + number(quint32(rate * channels * 4)) + number(quint16(channels * 4))
           + number(quint16(32)) + "data" + number(quint32(data.size())) + data;
}

} // namespace

void tst_cliDetect::findsTheLine()
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
    QVERIFY(tracksCsv.startsWith("track,t,f,statistic,f_low,f_high,presence,snr_db\n"));
    const auto rows = numbersOf(tracksCsv);
    QCOMPARE(rows.front()[1], event[1]); // from onset …
    QCOMPARE(rows.back()[1], event[3]);  // … to end, a row per frame
    QCOMPARE(std::ssize(rows), Index(std::llround((event[3] - event[1]) / 0.25)) + 1);
    for (const std::vector<double> &row : rows)
        if (row[1] > 10.0 && row[1] < 22.0)
            QVERIFY2(std::abs(row[2] - (210.0 + 0.2 * (row[1] - 8.0))) <= 3.0, tracksCsv.data());
}

void tst_cliDetect::statisticHasTheFramesShape()
{
    // 30 s of 0.5-s windows that overlap by half; transforms of 1000 samples.
    const NumPyArray array = readNumPy(pathOf("D.npy"));
    QCOMPARE(array.shape, (std::vector<Index>{119, 501}));
    QVERIFY(std::ranges::all_of(array.values, [](float value) { return std::isfinite(value); }));
}

void tst_cliDetect::saysWhatItFoundWhereNothingIsWritten()
{
    const Outcome asked = run(QStringList{"detect", "line.wav", "--summary"} + lineSettings);
    const Outcome alone = run(QStringList{"detect", "line.wav"} + lineSettings);
    QCOMPARE(alone.code, 0);
    QVERIFY(alone.out.contains("\n1 event(s)\n"));
    QCOMPARE(alone.out, asked.out);
    QCOMPARE(run(QStringList{"detect", "line.wav", "--events", "quiet.csv"} + lineSettings).out, QByteArray());
}

void tst_cliDetect::theBandMayHaveOneEdge()
{
    const Outcome above = run(QStringList{"detect", "line.wav", "--low", "150"} + lineSettings);
    QVERIFY2(above.out.startsWith("119 frames of 351 cells"), (above.out + above.err).data()); // 150 … 500 Hz
    const Outcome below = run(QStringList{"detect", "line.wav", "--high", "150"} + lineSettings);
    QVERIFY2(below.out.startsWith("119 frames of 151 cells"), (below.out + below.err).data());
    QVERIFY(run(QStringList{"detect", "line.wav", "--low", "100", "--high", "300"} + lineSettings)
                .out.startsWith("119 frames of 201 cells"));
}

void tst_cliDetect::threadsChangeNoByte()
{
    const Outcome two = run(QStringList{"detect", "line.wav", "--threads", "2", "--events", "events2.csv", "--tracks",
                                        "tracks2.csv", "--statistic", "D2.npy", "--summary", "--progress", "json"}
                            + lineSettings);
    QCOMPARE(two.code, 0);
    QVERIFY(content("events2.csv") == content("events.csv"));
    QVERIFY(content("tracks2.csv") == content("tracks.csv"));
    QVERIFY(content("D2.npy") == content("D.npy"));

    // On the way: the summary where results go, progress where it does not get between them.
    QVERIFY2(two.out.startsWith("119 frames of 501 cells, 0.25 s per frame\n"), two.out.data());
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

void tst_cliDetect::printsTheEventsAsJson()
{
    const Outcome printed = run(QStringList{"detect", "line.wav", "--json", "--events", "printed.json"} + lineSettings);
    QCOMPARE(printed.err, QByteArray());
    QCOMPARE(printed.code, 0);
    QCOMPARE(printed.out, content("printed.json"));
    QCOMPARE(parseJson(printed.out.toStdString(), "events").at("events").size(), std::size_t(1));
    QCOMPARE(run(QStringList{"detect", "line.wav", "--json"} + lineSettings).out, printed.out);

    // With reviews the columns are those of a table with reviews.
    writeBytes(pathOf("box.csv"), "t_onset,t_end,f_low,f_high,label,review\n8,23,205,218,mine,accepted\n");
    const QStringList reviewed{"detect", "line.wav", "--annotations", "box.csv", "--json"};
    const Outcome judged = run(reviewed + QStringList{"--events", "judged.json"} + lineSettings);
    QCOMPARE(judged.err, QByteArray());
    QCOMPARE(judged.out, content("judged.json"));
    QVERIFY(judged.out.contains("accepted"));

    const Outcome both = run({"detect", "line.wav", "--json", "--summary"});
    QCOMPARE(both.code, 2);
    QVERIFY2(both.err.contains("--json"), both.err.data());
}

void tst_cliDetect::keptCalibrationsChangeNoByte()
{
    const QByteArray usual = qgetenv("FAINTLINE_CACHE");
    const QString folder = path("cache");
    QByteArrayList made;
    for (const QString &cache : {QStringLiteral("off"), folder, folder}) { // none, made, read back
        qputenv("FAINTLINE_CACHE", cache.toLocal8Bit());
        const Outcome outcome =
            run(QStringList{"detect", "line.wav", "--events", "kept.csv", "--tracks", "keptTracks.csv", "--statistic",
                            "kept.npy", "--set", "model.snr=0.7"} // of no shipped calibration
                + lineSettings);
        QCOMPARE(outcome.code, 0);
        const QByteArrayList written{content("kept.csv"), content("keptTracks.csv"), content("kept.npy")};
        if (made.isEmpty())
            made = written;
        QVERIFY(written == made);
        QVERIFY(written.front().count('\n') > 1);
        QCOMPARE(QDir(folder).entryList(QDir::Files).size(), cache == folder ? 1 : 0);
    }
    usual.isNull() ? qunsetenv("FAINTLINE_CACHE") : qputenv("FAINTLINE_CACHE", usual);
}

/// As the manual says of FAINTLINE_CACHE: a folder that a suite of tests brings along.
void tst_cliDetect::aFolderOfCalibrationsCanBeCopied()
{
    const QByteArray usual = qgetenv("FAINTLINE_CACHE");
    const auto detect = [this](const QString &cache) {
        qputenv("FAINTLINE_CACHE", path(cache).toLocal8Bit());
        return run(QStringList{"detect", "line.wav", "--json", "--set", "model.snr=0.9"} + lineSettings).out;
    };
    const QByteArray made = detect("made");
    const QStringList files = QDir(path("made")).entryList(QDir::Files);
    QCOMPARE(files.size(), 1);
    QVERIFY(QDir().mkpath(path("brought")));
    QVERIFY(QFile::copy(path("made/" + files.front()), path("brought/" + files.front())));
    const QByteArray before = content("brought/" + files.front());
    const QDateTime written = QFileInfo(path("brought/" + files.front())).lastModified();
    QCOMPARE(detect("brought"), made);
    QCOMPARE(QDir(path("brought")).entryList(QDir::Files), files);
    QCOMPARE(content("brought/" + files.front()), before);
    QCOMPARE(QFileInfo(path("brought/" + files.front())).lastModified(), written);
    usual.isNull() ? qunsetenv("FAINTLINE_CACHE") : qputenv("FAINTLINE_CACHE", usual);
}

void tst_cliDetect::isTheLibrary()
{
    std::vector<float> statistic;
    const auto analysis = inLibrary(pathOf("line.wav"), statistic);
    writeEvents(*analysis, pathOf("library.csv"));
    writeTracks(*analysis, pathOf("libraryTracks.csv"));
    QCOMPARE(content("library.csv"), content("events.csv"));
    QCOMPARE(content("libraryTracks.csv"), content("tracks.csv"));
    QCOMPARE(statistic, readNumPy(pathOf("D.npy")).values);
    // Noise is explained as the followed line is.
    const Explanation noise = explain(*analysis, 18.0, {400.0});
    QVERIFY(!noise.isTracked);
    QVERIFY(std::abs(noise.statistic - double(statistic[71 * 501 + 400])) < 1e-3);
    QVERIFY(contains(errorOf([&] { explain(*analysis, 99.0, {100.0}); }), "time 99 s: must lie in 0.25 … 29.75 s"));
    QVERIFY(contains(errorOf([&] { explain(*analysis, NAN, {100.0}); }), "time nan s: must lie in"));
    QVERIFY(contains(errorOf([&] { explain(*analysis, 9.0, {NAN}); }), "frequency nan: must be a number"));
}

void tst_cliDetect::explainsItsTerms()
{
    const Outcome told =
        run(QStringList{"explain", "line.wav", "--time", "18", "--frequency", "212", "--json"} + lineSettings);
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
    const auto frame = std::size_t(std::llround((json["time"].get<double>() - 0.25) / 0.25));
    const auto bin = std::size_t(std::llround(json["position"][0].get<double>()));
    const auto shown = double(D.values[frame * 501 + bin]);
    QVERIFY2(std::abs(shown - statistic) < 1e-3,
             qPrintable(QString("D.npy %1, explained %2").arg(shown).arg(statistic)));
    QVERIFY(std::abs(shown - json["displayed"].get<double>()) < 1e-5);
}

void tst_cliDetect::framesInPlaceOfARecording()
{
    // Exponential noise with a target that climbs a cell a frame from cell 5 on.
    Random random(1, 1);
    std::vector<float> y(40 * 50);
    for (float &value : y)
        value = float(random.exponential());
    for (std::size_t frame = 10; frame < 30; ++frame)
        y[frame * 50 + frame + 5] += 9.0f;
    writeArray(pathOf("y.npy"), {40, 50}, y);
    writeBytes(
        pathOf("grid.json"),
        R"({"axes": [{"name": "range", "unit": "m", "first": 1000, "step": 10}], "time": {"first": 5, "step": 2}})");
    writeBytes(pathOf("model.json"),
               R"({"axes": [{"cells": 50, "rates": [-1, 0, 1], "rateChange": [1]}], "likelihood": {"kind": "linear"},
        "reset": {"law": "fixed", "lnK": -1.4}})");
    const Outcome found =
        run({"detect", "--frames", "y.npy", "--grid", "grid.json", "--model", "model.json", "--set",
             "decide.thresholdNats=20", "--events", "target.csv", "--tracks", "target.json", "--statistic", "T.npy"});
    QCOMPARE(found.err, QByteArray());
    QCOMPARE(found.code, 0);
    const auto events = numbersOf(content("target.csv"));
    QCOMPARE(events.size(), std::size_t(1));
    const double detect = events[0][2];
    QVERIFY(detect >= 25.0 && detect < 65.0);
    const double middle = 0.5 * (events[0][1] + events[0][3]); // frame (t - 5)/2, cell frame + 5
    QVERIFY2(std::abs(events[0][4] - (1000.0 + 10.0 * ((middle - 5.0) / 2.0 + 5.0))) <= 20.0,
             content("target.csv").data());
    QVERIFY2(std::abs(events[0][5] - 5.0) < 0.6, content("target.csv").data()); // 10 m in 2 s
    QCOMPARE(readNumPy(pathOf("T.npy")).shape, (std::vector<Index>{40, 50}));
    const Outcome recorded = run({"detect", "line.wav", "--model", "model.json", "--events", "none.csv"});
    QCOMPARE(recorded.code, 2);
    QVERIFY2(recorded.err.startsWith("error: --model: requires ready-made frames"), recorded.err.data());
    const Outcome told = run({"detect", "--frames", "y.npy", "--summary", "--set", "model.slopeUnit=hzPerSecond"});
    QCOMPARE(told.code, 2);
    QVERIFY2(told.err.startsWith("error: model.slopeUnit = hzPerSecond: needs a recording"), told.err.data());
}

// Half a second, two frames and two bins a cell: 4 Hz/s are a bin a frame, and what is between two slopes goes
// outwards.
void tst_cliDetect::slopesInHertzAreTheSame()
{
    const Outcome found =
        run(QStringList{"detect", "line.wav", "--events", "hertz.csv", "--set", "model.slopeUnit=hzPerSecond", "--set",
                        "model.lowestSlope=-4", "--set", "model.highestSlope=3.6"}
            + lineSettings);
    QCOMPARE(found.err, QByteArray());
    QCOMPARE(content("hertz.csv"), content("events.csv"));
}

void tst_cliDetect::pingsFromAScene()
{
    writeBytes(
        pathOf("pings.json"),
        R"({"kind": "pings", "pings": 30, "rangeCells": 90, "beams": 8, "targets": [{"snrDb": 12, "rangeMetres": 3200,
        "bearingDegrees": 315, "appearPing": 4, "legs": [{"rangeCellsPerPing": 2, "beamsPerPing": 0.2}]}]})");
    const Outcome info = run({"info", "pings.json"});
    QVERIFY2(info.out.contains("range         90 cells of 10 m, 3000 … 3890 m")
                 && info.out.contains("target 1      12 dB, constant, pings 4 … 29"),
             info.out.data());
    QCOMPARE(run({"simulate", "pings.json", "--out", "P.npy", "--truth", "P.truth.json"}).code, 0);
    QCOMPARE(readNumPy(pathOf("P.npy")).shape, (std::vector<Index>{30, 90, 8}));
    const Json truth = parseJson(content("P.truth.json").toStdString(), "truth");
    QCOMPARE(truth["targets"][0]["cell"].size(), std::size_t(26));
    // From the scene and from the frames written: the same events, byte for byte.
    const QStringList settings{"--preset", "sonar", "--set", "decide.thresholdNats=20"};
    QCOMPARE(run(QStringList{"detect", "pings.json", "--events", "a.csv"} + settings).code, 0);
    QCOMPARE(
        run(QStringList{"detect", "--frames", "P.npy", "--grid", "P.grid.json", "--events", "b.csv"} + settings).code,
        0);
    QVERIFY(content("a.csv").startsWith("event,t_onset,t_detect,t_end,range,bearing,drift_hz_per_s,statistic,confirmed,"
                                        "open,range_per_s,bearing_per_s\n"));
    QCOMPARE(content("a.csv"), content("b.csv"));
    bool isFound = false;
    for (const auto &event : numbersOf(content("a.csv"))) // 20 m and 9° in 40 s
        isFound = isFound || (event[8] == 1.0 && std::abs(event[10] - 0.5) < 0.1 && std::abs(event[11] - 0.225) < 0.1);
    QVERIFY2(isFound, content("a.csv").data());
    // The targets of the scene, and of the truth beside the frames.
    const auto scoreOf = [&](const QString &file) {
        const QByteArray summary = run(QStringList{"detect", file, "--summary"} + settings).out;
        return summary.mid(summary.indexOf("target 1: detected"));
    };
    QVERIFY2(scoreOf("P.npy").contains("false tracks:"), scoreOf("P.npy").data());
    QCOMPARE(scoreOf("P.npy"), scoreOf("pings.json"));
    writeBytes(pathOf("P.truth.json"),
               R"({"targets": [{"rangeMetres": [3000], "bearingDegrees": [0], "cell": [720]}]})");
    const Outcome beyond = run(QStringList{"detect", "P.npy", "--summary"} + settings);
    QCOMPARE(beyond.code, 2);
    QVERIFY2(beyond.err.contains("P.truth.json: has a target beyond the 720 cells"), beyond.err.data());
    // The same cell is explained of the scene and of its frames.
    const QStringList cell{"--time", "960", "--range", "3400", "--bearing", "0", "--json"};
    const Outcome why = run(QStringList{"explain", "pings.json"} + cell + settings);
    QCOMPARE(why.err, QByteArray());
    const Json json = parseJson(why.out.toStdString(), "explain");
    double sum = json["offset"].get<double>();
    for (const Json &step : json["steps"])
        sum += step["llr"].get<double>() + step["ln_transition"].get<double>() + step["lnK"].get<double>();
    QVERIFY(std::abs(sum - json["statistic"].get<double>()) < 1e-6);
    QVERIFY(std::abs(sum - json["displayed"].get<double>()) < 1e-3);
    QCOMPARE(json["position"].size(), std::size_t(2));
    const Outcome unnamed =
        run(QStringList{"explain", "pings.json", "--time", "960", "--frequency", "3400"} + settings);
    QCOMPARE(unnamed.code, 2);
    QVERIFY(unnamed.err.contains("--range and --bearing"));
    // Beside it, the conventional detector.
    QCOMPARE(run(QStringList{"detect", "pings.json", "--conventional", "c.csv"} + settings).code, 0);
    QVERIFY(content("c.csv").startsWith("event,t_onset,t_detect,t_end,range,bearing,"));
    QVERIFY(content("c.csv").count('\n') >= 2); // 12 dB show in a ping by themselves

    const Outcome wrong = run({"simulate", "pings.json", "--out", "P.wav"});
    QCOMPARE(wrong.code, 2);
    QVERIFY(wrong.err.contains("P.wav: must end in .npy"));
}

void tst_cliDetect::oddRecordings_data()
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
    QTest::newRow("no number at all") << wav(1000, 1, std::vector<float>(8000, NAN)) << true;
}

void tst_cliDetect::oddRecordings()
{
    QFETCH(QByteArray, bytes);
    QFETCH(bool, isRefused);
    writeBytes(pathOf("odd.wav"), bytes);
    if (isRefused) {
        const Outcome told =
            run(QStringList{"detect", "odd.wav", "--events", "odd.csv", "--statistic", "odd.npy"} + lineSettings);
        QCOMPARE(told.code, 2);
        QCOMPARE(told.out, QByteArray());
        QVERIFY2(told.err.startsWith("error: ") && told.err.count('\n') == 1, told.err.data());
        QVERIFY(QDir(folder()).entryList({"odd.csv*", "odd.npy*"}, QDir::Files | QDir::Hidden).isEmpty());
        return;
    }
    // The library, which is the program (isTheLibrary): it calibrates once for all of them.
    std::vector<float> statistic;
    const auto analysis = inLibrary(pathOf("odd.wav"), statistic);
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

void tst_cliDetect::samplesThatAreNoNumbers()
{
    std::vector<float> samples = someNoise(8000);
    std::fill_n(samples.begin() + 3000, 400, NAN);
    samples[5] = INFINITY;
    writeBytes(pathOf("nan.wav"), wav(1000, 1, samples));
    const Outcome done =
        run(QStringList{"detect", "nan.wav", "--events", "nan.csv", "--statistic", "nan.npy"} + lineSettings);
    QCOMPARE(done.err, QByteArray("note: nan.wav: 401 sample(s) are not finite; frames that reach into them are not "
                                  "observed.\n"));
    QCOMPARE(done.code, 0);
    const QByteArray events = content("nan.csv");
    QVERIFY2(events.count('\n') == 1 || !numbersOf(events).empty(), events.data());
    QVERIFY2(!events.contains("nan") && !events.contains("inf"), events.data());
    QVERIFY(std::ranges::all_of(readNumPy(pathOf("nan.npy")).values, [](float value) { return std::isfinite(value); }));
}

/// In the words of `info`: in the summary, or, without one, on standard error. Here a gap and an empty file.
void tst_cliDetect::passesOnTheRecordingsNotes()
{
    QVERIFY(QDir(folder()).mkpath("night"));
    writeBytes(pathOf("night/20260301_000000.wav"), wav(1000, 1, someNoise(8000)));
    writeBytes(pathOf("night/20260301_000010.wav"), {});
    writeBytes(pathOf("night/20260301_000020.wav"), wav(1000, 1, someNoise(8000)));
    QList<QByteArray> notes;
    for (const QByteArray &line : run({"info", "night"}).out.split('\n'))
        if (line.startsWith("note  "))
            notes.push_back(line.mid(4).trimmed());
    QVERIFY(notes.size() >= 3);
    const Outcome summary = run(QStringList{"detect", "night", "--summary"} + lineSettings);
    QCOMPARE(summary.err, QByteArray());
    const Outcome events = run(QStringList{"detect", "night", "--events", "night.csv"} + lineSettings);
    QCOMPARE(events.out, QByteArray());
    for (const QByteArray &note : notes) {
        QVERIFY2(summary.out.contains("\nnote: " + note + '\n'), summary.out.data());
        QVERIFY2(events.err.contains("note: night: " + note + '\n'), events.err.data());
    }
}

FAINTLINE_TEST(tst_cliDetect)
#include "tst_cliDetect.moc"
