#include "exchange/writeEvents.h"
#include "support/test.h"

#include "analyse/columns.h"
#include "base/json.h"
#include "exchange/writeReviewed.h"
#include "support/CommaLocale.h"
#include "support/recordings.h"

using namespace faintline;
using namespace faintline::test;

namespace {

/// Frames every half second from 0.25 s on; bins of 2.5 Hz from 1000 Hz on.
Analysis twoTracks()
{
    Analysis analysis;
    analysis.settings.track.bothWays = false;
    const Axis time{"time", "s", 0.25, 0.5, 8, false};
    const Grid grid{{{"frequency", "Hz", 1000.0, 2.5, 10, false}}};
    analysis.frames = std::make_shared<FrameArray>(time, grid, std::vector<float>(80, 1.0f));
    auto calibration = std::make_shared<Calibration>();
    calibration->lnK = -0.125;
    analysis.calibration = calibration;
    analysis.threshold = 12.5;
    // In order of detection: the second one began earlier.
    Track rising{1, 2, 3, 5, 14.75, true, false, {{2, 4, 0, 2.0}, {3, 5, 0, 13.0}, {4, 6, 0, 14.75}, {5, 7, 0, 9.5}}};
    Track steady{2, 1, 4, 7, 1.0 / 3.0, false, true, {}};
    for (Index frame = 1; frame <= 7; ++frame)
        steady.points.push_back({frame, 1, 0, 0.1 * double(frame)});
    analysis.tracks = {rising, steady};
    return analysis;
}

Event completeEvent(std::size_t axes)
{
    Event event;
    event.id = 1;
    event.position.resize(axes);
    event.ratesPerSecond.resize(axes);
    event.isSubtracted = true;
    event.modelChanges = {{1.0, 1}};
    event.snrDb = event.bandWidth = event.noiseProbability = event.windowSeconds = 0.0;
    event.kind = SignalKind::Keyed;
    event.call = 3;
    return event;
}

} // namespace

/// Events and tracks as files, from an analysis made by hand: every column, every unit, every kind of file.
class tst_writeEvents : public QObject
{
    Q_OBJECT

private slots:
    void eventsAsCsv()
    {
        // By onset. The rising one climbs a bin, 2.5 Hz, a frame, half a second: 5 Hz/s; at its detection it is in bin 5.
        QCOMPARE(written(twoTracks(), "e.csv"),
                 QByteArray("event,t_onset,t_detect,t_end,f,drift_hz_per_s,statistic,confirmed,open\n"
                            "2,0.75,2.25,3.75,1002.5,0,0.3333333333333333,0,1\n"
                            "1,1.25,1.75,2.75,1013.75,5,14.75,1,0\n"));
    }

    void tracksAsCsv()
    {
        const QByteArray text = written(twoTracks(), "t.csv", true);
        QVERIFY(text.startsWith("track,t,f,statistic\n"
                                "1,1.25,1010,2\n"
                                "1,1.75,1012.5,13\n"
                                "1,2.25,1015,14.75\n"
                                "1,2.75,1017.5,9.5\n"
                                "2,0.75,1002.5,0.1\n"));
        QCOMPARE(text.count('\n'), qsizetype(1 + 4 + 7));
        QVERIFY(text.endsWith("2,3.75,1002.5,0.7000000000000001\n"));
    }

    void eventsAsJson()
    {
        const Json json = parseJson(written(twoTracks(), "e.json").toStdString(), "e.json");
        QCOMPARE(json["threshold"].get<double>(), 12.5);
        QCOMPARE(json["lnK"].get<double>(), -0.125);
        QCOMPARE(json["events"].size(), std::size_t(2));
        const Json &first = json["events"][0];
        QCOMPARE(first["event"].get<int>(), 2);
        QCOMPARE(first["t_onset"].get<double>(), 0.75);
        QCOMPARE(first["t_detect"].get<double>(), 2.25);
        QCOMPARE(first["t_end"].get<double>(), 3.75);
        QCOMPARE(first["f"].get<double>(), 1002.5);
        QCOMPARE(first["drift_hz_per_s"].get<double>(), 0.0);
        QCOMPARE(first["statistic"].get<double>(), 1.0 / 3.0); // to the last bit
        QCOMPARE(first["confirmed"].get<bool>(), false);
        QCOMPARE(first["open"].get<bool>(), true);
        QVERIFY(settingsFromJson(json["settings"].dump(), "settings") == twoTracks().settings);
    }

    void tracksAsJson()
    {
        const Json json = parseJson(written(twoTracks(), "t.json", true).toStdString(), "t.json");
        QCOMPARE(json.size(), std::size_t(2));
        QCOMPARE(json[0]["track"].get<int>(), 1);
        QCOMPARE(json[0]["t"].get<std::vector<double>>(), (std::vector<double>{1.25, 1.75, 2.25, 2.75}));
        QCOMPARE(json[0]["f"].get<std::vector<double>>(), (std::vector<double>{1010, 1012.5, 1015, 1017.5}));
        QCOMPARE(json[0]["statistic"].get<std::vector<double>>(), (std::vector<double>{2, 13, 14.75, 9.5}));
    }

    void pausesOfTracks()
    {
        Analysis analysis = twoTracks();
        analysis.tracks.resize(1);
        Track &rising = analysis.tracks.front();
        for (const float presence : {1.0f, 0.9f, 0.2f, 0.8f}) {
            const auto position = double(rising.points[rising.smoothed.size()].cell);
            rising.smoothed.push_back({position, float(position - 0.5), float(position + 0.5), presence, 4.0f});
        }
        rising.points[2].cell = 9; // in the pause, where the path may be anywhere
        rising.smoothed[2].position = 9.0;
        const QByteArray text = written(analysis, "t.csv", true);
        QCOMPARE(text.count('\n'), qsizetype(1 + 3));
        QVERIFY(text.contains("\n1,1.25,1010,2") && text.contains("\n1,1.75,1012.5,13")
                && text.contains("\n1,2.75,1017.5,"));
        const Json json = parseJson(written(analysis, "t.json", true).toStdString(), "t.json");
        QCOMPARE(json[0]["t"].get<std::vector<double>>(), (std::vector<double>{1.25, 1.75, 2.75}));
        QCOMPARE(json[0]["f"].get<std::vector<double>>(), (std::vector<double>{1010, 1012.5, 1017.5}));
    }

    void audacityLabels()
    {
        // Begin, end, label, separated by tabs.
        QCOMPARE(written(twoTracks(), "e.txt"), QByteArray("0.75\t3.75\t1002.5 Hz, 0.3 nat\n"
                                                           "1.25\t2.75\t1013.75 Hz, 14.8 nat\n"));
    }

    void sigmfAnnotations()
    {
        Analysis analysis = twoTracks();
        analysis.recording = std::make_shared<MemoryRecording>(std::vector<float>(2 * 8000), 2000.0, true, 7e6);
        const Json json = parseJson(written(analysis, "e.sigmf-meta").toStdString(), "e.sigmf-meta");
        QVERIFY(json["global"].contains("core:version"));
        QCOMPARE(json["global"]["core:sample_rate"].get<double>(), 2000.0);
        QCOMPARE(json["captures"][0]["core:sample_start"].get<int>(), 0);
        QCOMPARE(json["captures"][0]["core:frequency"].get<double>(), 7e6);
        QCOMPARE(json["annotations"].size(), std::size_t(2));
        // Samples and absolute frequencies; the specification wants annotations in order of their start.
        const Json &steady = json["annotations"][0];
        QCOMPARE(steady["core:sample_start"].get<int>(), 1500);
        QCOMPARE(steady["core:sample_count"].get<int>(), 6000);
        QCOMPARE(steady["core:freq_lower_edge"].get<double>(), 7001002.5);
        QCOMPARE(steady["core:freq_upper_edge"].get<double>(), 7001002.5);
        const Json &rising = json["annotations"][1];
        QCOMPARE(rising["core:sample_start"].get<int>(), 2500);
        QCOMPARE(rising["core:sample_count"].get<int>(), 3000);
        QCOMPARE(rising["core:freq_lower_edge"].get<double>(), 7001010.0);
        QCOMPARE(rising["core:freq_upper_edge"].get<double>(), 7001017.5);
        for (const Json &annotation : json["annotations"])
            QVERIFY(annotation["core:label"].is_string() && annotation["core:comment"].is_string());

        Analysis frames = twoTracks();
        QVERIFY(contains(errorOf([&] { writeEvents(frames, path("f.sigmf-meta")); }), "require a recording"));
        QVERIFY(!QFile::exists(m_folder.filePath("f.sigmf-meta")));
    }

    void severalAxes()
    {
        // A sonar's events have a column for each of their axes.
        Analysis analysis = twoTracks();
        const Grid grid{{{"bearing", "°", 0.0, 90.0, 2, true}, {"range", "m", 100.0, 10.0, 5, false}}};
        analysis.frames = std::make_shared<FrameArray>(analysis.time(), grid, std::vector<float>(80, 1.0f));
        const QByteArray events = written(analysis, "s.csv");
        QVERIFY(events.startsWith("event,t_onset,t_detect,t_end,bearing,range,drift_hz_per_s,statistic,confirmed,open,"
                                  "bearing_per_s,range_per_s\n"
                                  "2,0.75,2.25,3.75,0,110,0,"));
        const QByteArray tracks = written(analysis, "st.csv", true);
        QVERIFY(tracks.startsWith("track,t,bearing,range,statistic\n"
                                  "1,1.25,0,140,2\n"
                                  "1,1.75,90,100,13\n"));
        const Json json = parseJson(written(analysis, "s.json").toStdString(), "s.json");
        QCOMPARE(json["events"][1]["bearing"].get<double>(), 90.0);
        QCOMPARE(json["events"][1]["range"].get<double>(), 100.0);
    }

    void aBanksModels()
    {
        // Found by the first model; the second one takes over in frame 4, the first one again in frame 5.
        Analysis analysis = twoTracks();
        analysis.bank.resize(2);
        analysis.tracks[0].modelChanges = {{4, 1}, {5, 0}};
        analysis.tracks[1].model = 1;
        const QByteArray events = written(analysis, "b.csv");
        QVERIFY(events.startsWith(
            "event,t_onset,t_detect,t_end,f,drift_hz_per_s,statistic,confirmed,open,model,model_changes\n"));
        QVERIFY(events.contains(",0,1,manoeuvring,\n"));
        QVERIFY(events.endsWith(",1,0,nonManoeuvring,2.25:manoeuvring;2.75:nonManoeuvring\n"));
        const QByteArray tracks = written(analysis, "bt.csv", true);
        QVERIFY(tracks.startsWith("track,t,f,statistic,model\n"
                                  "1,1.25,1010,2,nonManoeuvring\n"
                                  "1,1.75,1012.5,13,nonManoeuvring\n"
                                  "1,2.25,1015,14.75,manoeuvring\n"
                                  "1,2.75,1017.5,9.5,nonManoeuvring\n"));
        QVERIFY(tracks.contains("\n2,0.75,1002.5,0.1,manoeuvring\n"));
        const Json json = parseJson(written(analysis, "b.json").toStdString(), "b.json");
        QCOMPARE(json["events"][1]["model"].get<std::string>(), std::string("nonManoeuvring"));
        QCOMPARE(json["events"][1]["model_changes"][0]["t"].get<double>(), 2.25);
        const Json along = parseJson(written(analysis, "bt.json", true).toStdString(), "bt.json");
        QCOMPARE(along[0]["model"].size(), std::size_t(4));
        QCOMPARE(along[0]["model"][2].get<std::string>(), std::string("manoeuvring"));
    }

    void nothingFound()
    {
        Analysis analysis = twoTracks();
        analysis.tracks.clear();
        analysis.recording = std::make_shared<MemoryRecording>(std::vector<float>(10), 2000.0);
        QCOMPARE(written(analysis, "none.csv").count('\n'), qsizetype(1)); // the header alone
        QCOMPARE(written(analysis, "none.txt"), QByteArray());
        QVERIFY(parseJson(written(analysis, "none.json").toStdString(), "")["events"].empty());
        QVERIFY(parseJson(written(analysis, "none.sigmf-meta").toStdString(), "")["annotations"].is_array());
        QCOMPARE(written(analysis, "nonet.csv", true), QByteArray("track,t,f,statistic\n"));
        QVERIFY(parseJson(written(analysis, "nonet.json", true).toStdString(), "").is_array());
    }

    void everyColumnIsInEveryFile_data()
    {
        QTest::addColumn<std::shared_ptr<Analysis>>("analysis");
        const auto lines = std::make_shared<Analysis>(twoTracks());
        lines->settings.track.bothWays = true;
        lines->settings.subtract.lines = true;
        QTest::newRow("lines of a recording") << lines;
        const auto pings = std::make_shared<Analysis>(twoTracks());
        const Grid grid{{{"bearing", "°", 0.0, 90.0, 2, true}, {"range", "m", 100.0, 10.0, 5, false}}};
        pings->frames = std::make_shared<FrameArray>(pings->time(), grid, std::vector<float>(80, 1.0f));
        pings->bank.resize(2);
        QTest::newRow("pings with a bank") << pings;
    }

    void everyColumnIsInEveryFile()
    {
        QFETCH(std::shared_ptr<Analysis>, analysis);
        const auto namesIn = [](const QByteArray &csv) { return csv.left(csv.indexOf('\n')).split(','); };
        const Event event = completeEvent(analysis->grid().axes.size());
        writeReviewed(*analysis, {event}, {}, path("r.csv"));
        writeReviewed(*analysis, {event}, {}, path("r.json"));
        const Json reviewed = parseJson(readBytes(path("r.json")).toStdString(), "r.json")["events"][0];
        const Json json = parseJson(eventsJson(*analysis, {event}), "e.json")["events"][0];
        const auto columns = eventColumns(analysis->grid(), OptionalColumns::of(*analysis));
        QVERIFY(std::ranges::any_of(columns, &TableColumn<Event>::isOptional));
        for (const TableColumn<Event> &column : columns) {
            const QByteArray name = QByteArray::fromStdString(column.name);
            for (const QByteArray &csv :
                 {QByteArray::fromStdString(eventsCsv(*analysis, {event})), readBytes(path("r.csv"))})
                QVERIFY2(namesIn(csv).contains(name), name.constData());
            const bool isOfAnotherKind = name == "spread"; // an event has one
            QVERIFY2(isOfAnotherKind != (json.contains(column.name) && reviewed.contains(column.name)),
                     name.constData());
        }
        const QList<QByteArray> names = namesIn(written(*analysis, "t.csv", true));
        const Json track = parseJson(written(*analysis, "t.json", true).toStdString(), "t.json")[0];
        for (const TableColumn<TrackPlace> &column : trackColumns(analysis->grid(), OptionalColumns::of(*analysis)))
            QVERIFY2(names.contains(column.name.c_str()) && track.contains(column.name), column.name.c_str());
    }

    void drawnPiecesStandBesideTheirEvent()
    {
        const Analysis analysis = twoTracks();
        const std::vector<Event> all = events(analysis);
        const SignalPath piece{{1.25, 2.0}, {{1004.0}, {1001.5}}, {5.0}};
        Annotations annotations{withDrawn({}, analysis, all, 2, {piece}), {}};
        annotations.reviews = withVerdict(annotations.reviews, analysis, all, {2}, Verdict::Accepted);
        writeReviewed(analysis, all, annotations, path("drawn.csv"));
        writeReviewed(analysis, all, {}, path("plain.csv"));
        const QList<QByteArray> rows = readBytes(path("drawn.csv")).trimmed().split('\n');
        QCOMPARE(rows.size(), 4);
        QCOMPARE(rows[2], QByteArray(",1.25,,2,,,,,,1001.5,1004,accepted,2,\"event 2 (drawn)\",\"\""));
        QCOMPARE(rows[3], readBytes(path("plain.csv")).trimmed().split('\n')[2]); // what was measured stays
    }

    void refusals()
    {
        for (const char *name : {"e.xml", "e", "csv"})
            QVERIFY(contains(errorOf([&] { writeEvents(twoTracks(), path(name)); }),
                             "must end in one of .csv, .json, .txt (Audacity labels) or .sigmf-meta"));
        QVERIFY(
            contains(errorOf([&] { writeTracks(twoTracks(), path("t.txt")); }), "must end in one of .csv or .json"));
        QVERIFY(!errorOf([&] { writeEvents(twoTracks(), path("no/folder.csv")); }).empty());
    }

private:
    std::string path(const char *name) const { return m_folder.filePath(name).toStdString(); }
    QByteArray written(const Analysis &analysis, const char *name, bool isTracks = false) const
    {
        (isTracks ? writeTracks : writeEvents)(analysis, path(name));
        return readBytes(path(name));
    }

    QTemporaryDir m_folder;
    test::CommaLocale m_locale; ///< for every test of the class
};

FAINTLINE_TEST(tst_writeEvents)
#include "tst_writeEvents.moc"
