#include "exchange/survey/SurveyDatabase.h"
#include "support/test.h"

#include "base/files/AtomicFile.h"
#include "base/json.h"
#include "exchange/readAnnotations.h"
#include "exchange/survey/exportSurvey.h"
#include "exchange/survey/surveySchema.h"
#include "exchange/survey/writeSurvey.h"
#include "support/recordings.h"

#include <cmath>
#include <filesystem>
#include <limits>

using namespace faintline;
using namespace faintline::test;

namespace {

const double none = std::numeric_limits<double>::quiet_NaN();

/// A recording with two events, numbers of which need every bit.
SurveyOutcome outcomeOf(const std::string &path, double first = 0.1)
{
    SurveyOutcome outcome;
    SurveyRecording &r = outcome.recording;
    r.file = {path, 1234, 1'700'000'000'123'456'789, "abc"};
    r.container = "WAV";
    r.sampleRateHz = 8000.0;
    r.durationSeconds = 30.0;
    r.centreHz = 0.0;
    r.startUnixSeconds = 1.7e9;
    r.settings = "{}";
    r.windowSeconds = 0.5;
    r.threshold = 1.0 / 3.0;
    r.unit = "nat";
    r.lnK = -0.125;
    SurveyEvent event;
    event.event.id = 2;
    event.event.onsetSeconds = first;
    event.event.detectSeconds = first + 1.0;
    event.event.endSeconds = first + 2.0;
    event.event.position = {0.1 + 0.2};
    event.event.driftPerSecond = -1e-17;
    event.event.statistic = 1e300;
    event.event.isConfirmed = true;
    event.event.snrDb = 3.7;
    event.box.lowHz = 0.25;
    event.box.highHz = 0.5;
    outcome.events.push_back(event);
    event.event.id = 1;
    event.event.onsetSeconds = 5.0;
    event.event.endSeconds = 7.0;
    event.event.snrDb = none;
    event.event.isOpen = true;
    outcome.events.push_back(event);
    outcome.points = {{1, {5.0, 0.3, 1.5, none, none, none, none}}, {2, {first, 1.0 / 7.0, 2.5, 0.1, 0.2, 0.9, -3.0}}};
    outcome.areas = {{1.0, 2.0, 100.0, 200.0, 6.0}};
    return outcome;
}

bool same(double a, double b)
{
    return a == b || (std::isnan(a) && std::isnan(b));
}

} // namespace

/// A survey's database: what is put in comes out to the last bit, the same content gives the same bytes, and a file
/// that is no survey is refused in one line.
class tst_SurveyDatabase : public QObject
{
    Q_OBJECT

private slots:
    void init() { m_folder = std::make_unique<QTemporaryDir>(); }

    void everyBitComesBack()
    {
        const SurveyOutcome put = outcomeOf(path("a.wav"));
        SurveyDatabase database(written("s.sqlite", {put}));
        QVERIFY(database.isFinished());
        QVERIFY(database.origin() == originOf({}));
        const std::vector<SurveyRecording> recordings = database.recordings();
        QCOMPARE(recordings.size(), std::size_t(1));
        const SurveyRecording &r = recordings.front();
        QCOMPARE(r.file.path, put.recording.file.path);
        QCOMPARE(r.file.bytes, put.recording.file.bytes);
        QCOMPARE(r.file.modified, put.recording.file.modified);
        QCOMPARE(*r.threshold, 1.0 / 3.0);
        QVERIFY(r.isAnalysed());
        const std::vector<SurveyEvent> events = database.events(r.id);
        QCOMPARE(events.size(), put.events.size());
        for (std::size_t i = 0; i < events.size(); ++i) {
            const Event &a = events[i].event;
            const Event &b = put.events[i].event;
            QCOMPARE(a.id, b.id);
            for (const auto &[x, y] :
                 {std::pair(a.onsetSeconds, b.onsetSeconds), std::pair(a.detectSeconds, b.detectSeconds),
                  std::pair(a.endSeconds, b.endSeconds), std::pair(a.position.back(), b.position.back()),
                  std::pair(a.driftPerSecond, b.driftPerSecond), std::pair(a.statistic, b.statistic),
                  std::pair(a.snrDb, b.snrDb), std::pair(*events[i].box.lowHz, *put.events[i].box.lowHz)})
                QVERIFY(same(x, y));
            QCOMPARE(a.isConfirmed, b.isConfirmed);
            QCOMPARE(a.isOpen, b.isOpen);
        }
        const std::vector<SurveyPoint> points = database.points(r.id);
        QCOMPARE(points.size(), put.points.size());
        QCOMPARE(surveyTrackColumns().size(), points.front().values.size());
        for (std::size_t i = 0; i < points.size(); ++i)
            QVERIFY(points[i].track == put.points[i].track
                    && std::ranges::equal(points[i].values, put.points[i].values, same));
        QCOMPARE(database.areas(r.id).front().levelDb, 6.0);
    }

    void orderDoesNotMatter()
    {
        const SurveyOutcome a = outcomeOf(path("a.wav"), 0.1);
        const SurveyOutcome b = outcomeOf(path("b.wav"), 0.2);
        const SurveyOutcome c = outcomeOf(path("c/c.wav"), 0.3);
        const QByteArray bytes = readBytes(written("1.sqlite", {a, b, c}));
        QVERIFY(bytes.startsWith("SQLite format 3"));
        QCOMPARE(readBytes(written("2.sqlite", {c, a, b, a})), bytes);
        const std::vector<std::string> parts{written("p1.sqlite", {b}, "1/2"), written("p0.sqlite", {c, a}, "0/2")};
        mergeSurveys(parts, path("3.sqlite"));
        QCOMPARE(readBytes(path("3.sqlite")), bytes);
    }

    void pathsAreRelativeBelow()
    {
        const std::string database = path("s.sqlite");
        QCOMPARE(storedPath(path("night/a.wav"), database), std::string("night/a.wav"));
        QCOMPARE(storedPath("/elsewhere/a.wav", database), std::string("/elsewhere/a.wav"));
        const std::string odd = path("n\xff\"'\n.wav"); // a name that is no text
        SurveyDatabase survey(written("s.sqlite", {outcomeOf(odd), outcomeOf("/elsewhere/a.wav")}));
        QCOMPARE(survey.recordings()[0].file.path, std::string("/elsewhere/a.wav"));
        QCOMPARE(survey.recordings()[1].file.path, odd);
    }

    void aChangedRecordingReplacesItsRows()
    {
        const std::string file = written("s.sqlite", {outcomeOf(path("a.wav")), outcomeOf(path("b.wav"))});
        SurveyDatabase survey(file, Sqlite::Access::Write);
        SurveyOutcome changed;
        changed.recording.file = {path("a.wav"), 1, 2, "def"};
        changed.recording.reason = "cannot be read";
        survey.begin();
        survey.put(changed);
        survey.commit();
        QCOMPARE(survey.connection().integer("SELECT count(*) FROM recordings"), std::int64_t(2));
        QCOMPARE(survey.connection().integer("SELECT count(*) FROM events"), std::int64_t(2));
        QCOMPARE(survey.connection().integer("SELECT count(*) FROM tracks"), std::int64_t(2));
        for (const SurveyRecording &one : survey.recordings())
            QCOMPARE(one.reason, std::string(one.file.path == path("a.wav") ? "cannot be read" : ""));
    }

    void reviewsAreKept()
    {
        const std::string file = written("s.sqlite", {outcomeOf(path("a.wav")), outcomeOf(path("b.wav"))});
        {
            SurveyDatabase survey(file, Sqlite::Access::Write);
            const std::vector<SurveyEvent> events = survey.events(2);
            survey.setReview(path("b.wav"), events[1].event, Verdict::Rejected, "a hum");
            survey.setReview(path("b.wav"), events[0].event, Verdict::Accepted, "");
            survey.setReview(path("b.wav"), events[0].event, Verdict::None, ""); // taken back
            Event other = events[0].event;
            other.onsetSeconds += 1.0;
            for (const auto &[recording, event] : {std::pair(path("b.wav"), other), {path("c.wav"), events[0].event}})
                QCOMPARE(errorOf([&] { survey.setReview(recording, event, Verdict::Accepted, ""); }),
                         file + ": has changed since it was opened; open it again");
        }
        {
            SurveyDatabase survey(file, Sqlite::Access::Write);
            survey.put(outcomeOf(path("0.wav"))); // b.wav becomes the third
            writeSurvey({&survey}, survey.origin(), file);
        }
        SurveyDatabase survey(file);
        QCOMPARE(survey.connection().integer("SELECT count(*) FROM reviews"), std::int64_t(1));
        const std::vector<SurveyEvent> events = survey.events(3);
        QVERIFY(events[0].box.verdict == Verdict::None && events[1].box.verdict == Verdict::Rejected);
        QCOMPARE(events[1].box.note, std::string("a hum"));
        exportEvents(survey, path("e.csv"));
        QVERIFY(readBytes(path("e.csv")).endsWith(",rejected,\"a hum\"\n"));
    }

    void theDatabaseMayBeMoved()
    {
        QVERIFY(QDir(m_folder->path()).mkdir("db"));
        const std::string file = path("s.sqlite");
        std::filesystem::rename(written("db/s.sqlite", {outcomeOf(path("a.wav"))}), file);
        SurveyDatabase survey(file, Sqlite::Access::Write);
        QCOMPARE(survey.recordings().front().file.path, path("a.wav")); // stored whole, though it lies below now
        survey.setReview(path("a.wav"), survey.events(1).front().event, Verdict::Accepted, "");
        QCOMPARE(survey.connection().integer("SELECT count(*) FROM reviews"), std::int64_t(1));
        survey.put(outcomeOf(path("a.wav")));
        QCOMPARE(survey.connection().integer("SELECT count(*) FROM recordings"), std::int64_t(1));
        QCOMPARE(survey.connection().integer("SELECT count(*) FROM events"), std::int64_t(2));
    }

    void aReaderSeesOneMoment()
    {
        const std::string file = written("s.sqlite", {outcomeOf(path("a.wav"))});
        SurveyDatabase writer(file, Sqlite::Access::Write, std::chrono::milliseconds(50));
        {
            SurveyDatabase reader(file);
            reader.hold();
            QCOMPARE(reader.recordings().size(), std::size_t(1));
            writer.begin();
            writer.setUnfinished();
            QCOMPARE(errorOf([&] { writer.commit(); }), file + ": is in use by another program");
            QVERIFY(reader.isFinished());
        }
        writer.commit();
        QVERIFY(!SurveyDatabase(file).isFinished());
    }

    void mergesOnlyWhatBelongsTogether()
    {
        const std::string a = written("a.sqlite", {outcomeOf(path("a.wav"))}, "0/3");
        const std::string b = written("b.sqlite", {outcomeOf(path("b.wav"))}, "1/3");
        const std::string c = written("c.sqlite", {}, "2/3");
        const auto merged = [&](const std::vector<std::string> &parts) {
            return errorOf([&] { mergeSurveys(parts, path("m.sqlite")); });
        };
        QCOMPARE(merged({a, b}), path("m.sqlite") + ": shard 2/3 is missing");
        QVERIFY(!QFile::exists(m_folder->filePath("m.sqlite")));
        QVERIFY(contains(merged({a, b, c, a}), "a recording may be in one shard only"));
        beginSurvey(originOf({}, "2/3"), path("u.sqlite"));
        QCOMPARE(merged({a, b, path("u.sqlite")}),
                 path("u.sqlite") + ": is not finished; run the survey again to complete it");
        SurveySettings other;
        other.analysis.spectrogram.windowSeconds = 1.0;
        beginSurvey(originOf(other, "2/3"), path("o.sqlite"));
        change(path("o.sqlite"), "DELETE FROM provenance WHERE key = 'unfinished'");
        QVERIFY(contains(merged({a, b, path("o.sqlite")}), "is a survey with other settings"));
        QCOMPARE(merged({c, b, a}), std::string());
        QCOMPARE(SurveyDatabase(path("m.sqlite")).recordings().size(), std::size_t(2));
        QCOMPARE(merged({c, b, a}), std::string()); // once more
        {
            SurveyDatabase survey(path("m.sqlite"), Sqlite::Access::Write);
            survey.setReview(path("a.wav"), survey.events(1).front().event, Verdict::Accepted, "mine");
        }
        QVERIFY(contains(merged({c, b, a}), "contains reviews"));
        QCOMPARE(SurveyDatabase(path("m.sqlite")).events(1).front().box.note, std::string("mine"));
    }

    void otherSettingsAreNamed()
    {
        SurveySettings there;
        SurveySettings here;
        here.analysis.decide.falseAlarmsPerHour = 7.0;
        const auto said = [](const SurveyOrigin &a, const SurveyOrigin &b) {
            return errorOf([&] { checkOrigin(a, b, "s.sqlite"); });
        };
        QCOMPARE(said(originOf(there), originOf(here)),
                 std::string(
                     "s.sqlite: is a survey with other settings: decide.falseAlarmsPerHour = 1 there, 7 here; choose "
                     "another name for this survey"));
        here = there;
        here.open.iq = true;
        QVERIFY(contains(said(originOf(there), originOf(here)), "reading options: {} there, {\"iq\":true} here"));
        SurveyOrigin earlier = originOf(there); // the same in another order, with a short name
        earlier.reading = R"({"iq":false,"rawType":"ri16","rawRateHz":1000.0,"rawChannels":1,"rawHeaderBytes":0})";
        there.open = {false, "ri16_le", 1000.0, 1, 0};
        QCOMPARE(said(earlier, originOf(there)), std::string());
        here.open = {true, "ci16_le", 1e6, 2, 44};
        const SurveySettings back = settingsOf(originOf(here), "s.sqlite");
        QVERIFY(back.analysis == here.analysis && originOf(back) == originOf(here));
        QVERIFY(errorOf([&] { settingsOf({"{}", "[1]", {}, {}, {}}, "s.sqlite"); }).starts_with("s.sqlite"));
        SurveyOrigin older = originOf(there);
        older.version = "0.0.1";
        QVERIFY(contains(said(older, originOf(there)), "was written by Faintline 0.0.1; this is Faintline "));
        older = originOf(there);
        older.calibrations = "0";
        QVERIFY(contains(said(older, originOf(there)),
                         "was written with calibrations of version 0; here they have version "));
        QVERIFY(contains(said(originOf(there, "1/4"), originOf(there)), "contains shard 1/4, not a whole survey"));
        QCOMPARE(said(originOf(there), originOf(there)), std::string());
    }

    void noSurvey_data()
    {
        QTest::addColumn<QByteArray>("bytes");
        QTest::addColumn<QString>("sql");
        QTest::addColumn<QString>("complaint");
        QTest::newRow("text") << QByteArray("not a database, but long enough to be one").repeated(100) << QString()
                              << "is not an SQLite database";
        QTest::newRow("empty") << QByteArray() << QString() << "is not a survey";
        QTest::newRow("header only") << QByteArray("SQLite format 3\0", 16) << QString() << "is not a";
        QTest::newRow("of another program") << QByteArray() << "CREATE TABLE t(x)"
                                            << "is not a survey";
        QTest::newRow("a write-ahead log") << QByteArray("survey") << "PRAGMA journal_mode = WAL"
                                           << "is not a survey; ";
        QTest::newRow("another format") << QByteArray("survey") << "PRAGMA user_version = 2"
                                        << "reads format 1";
        QTest::newRow("a trigger") << QByteArray("survey")
                                   << "CREATE TRIGGER t AFTER INSERT ON reviews BEGIN DELETE FROM events; END"
                                   << "its tables differ";
        // SQLite refuses such a name, but not in a file that has it.
        QTest::newRow("a trigger in disguise")
            << QByteArray("survey") << "CREATE TRIGGER disguised AFTER INSERT ON reviews BEGIN DELETE FROM events; END"
            << "its tables differ";
        QTest::newRow("a view") << QByteArray("survey") << "CREATE VIEW v AS SELECT * FROM events"
                                << "its tables differ";
        QTest::newRow("a table is missing") << QByteArray("survey") << "DROP TABLE areas"
                                            << "its tables differ";
        QTest::newRow("another column") << QByteArray("survey") << "ALTER TABLE events ADD COLUMN x TEXT"
                                        << "its tables differ";
        QTest::newRow("no settings") << QByteArray("survey") << "DELETE FROM settings"
                                     << "contains no settings";
    }

    void noSurvey()
    {
        QFETCH(QByteArray, bytes);
        QFETCH(QString, sql);
        QFETCH(QString, complaint);
        std::string file = path("x.sqlite");
        if (bytes == "survey")
            file = written("x.sqlite", {outcomeOf(path("a.wav"))});
        else
            writeBytes(file, bytes);
        if (!sql.isEmpty())
            change(file, sql.toStdString());
        const QByteArray whole = readBytes(file).replace("disguised", "sqlite_xx");
        writeBytes(file, whole);
        const std::string said = errorOf([&] { SurveyDatabase database(file); });
        QVERIFY2(contains(said, complaint.toStdString()) && said.starts_with(file), said.c_str());
        QCOMPARE(readBytes(file), whole);
        QVERIFY(contains(errorOf([&] { SurveyDatabase database(path("none.sqlite")); }), "there is no such file"));
        QVERIFY(contains(errorOf([&] { SurveyDatabase database(m_folder->path().toStdString()); }), "is not a file"));
    }

    /// Cut anywhere, and overwritten anywhere: an error or a value, but no crash and no endless loop.
    void truncated()
    {
        std::vector<SurveyOutcome> outcomes;
        for (int i = 0; i < 60; ++i)
            outcomes.push_back(outcomeOf(path(std::to_string(i) + ".wav")));
        const QByteArray whole = readBytes(written("s.sqlite", outcomes));
        const auto readAll = [&](const QByteArray &bytes) {
            writeBytes(path("t.sqlite"), bytes);
            return errorOf([&] {
                SurveyDatabase survey(path("t.sqlite"));
                for (const SurveyRecording &one : survey.recordings()) {
                    survey.events(one.id);
                    survey.points(one.id);
                    survey.areas(one.id);
                }
            });
        };
        QCOMPARE(readAll(whole), std::string());
        for (const double share : {0.02, 0.1, 0.3, 0.5, 0.7, 0.9})
            QVERIFY(!readAll(whole.left(qsizetype(share * double(whole.size())))).empty());
        Random random(1, 0);
        int refused = 0;
        for (int i = 0; i < 100; ++i) {
            QByteArray damaged = whole;
            const auto at = qsizetype(random.uniform() * double(whole.size() - 64));
            for (qsizetype byte = at; byte < at + 64; ++byte)
                damaged[byte] = char(int(random.uniform() * 256.0));
            refused += readAll(damaged).empty() ? 0 : 1;
        }
        QVERIFY(refused > 0);
    }

    void hostileValues()
    {
        const auto said = [&](const std::string &sql, auto read) {
            const std::string file = written("h.sqlite", {outcomeOf(path("a.wav"))});
            change(file, sql);
            return errorOf([&] {
                SurveyDatabase survey(file);
                read(survey);
            });
        };
        const auto readEvents = [](SurveyDatabase &survey) { survey.events(1); };
        QVERIFY(contains(said("UPDATE events SET t_onset = 9e999", readEvents), "not finite"));
        QVERIFY(contains(said("UPDATE events SET event = event + 3000000000", readEvents), "too large"));
        QVERIFY(
            contains(said("UPDATE tracks SET f = -9e999", [](SurveyDatabase &survey) { survey.points(1); }), "finite"));
        // Times that no calendar has, in every export.
        const std::string file = written("h.sqlite", {outcomeOf(path("a.wav"))});
        change(file, "UPDATE recordings SET start_unix_s = 1e300, duration_s = 1e300");
        change(file, "UPDATE events SET t_onset = -1e300, t_end = 1e300");
        SurveyDatabase survey(file);
        exportEvents(survey, path("e.csv"));
        exportStoneSoup(survey, path("s.csv"), std::nullopt);
        exportLists(survey, SurveyList::Sigmf, path("lists"));
        QVERIFY(!errorOf([&] { exportCamtrap(survey, path("c"), {0.0, 0.0, {}}); }).empty());
    }

    void listsPerRecording()
    {
        SurveyDatabase survey(written("s.sqlite", {outcomeOf(path("night/a.wav"))}));
        exportLists(survey, SurveyList::Raven, path("raven"));
        exportLists(survey, SurveyList::Audacity, path("audacity"));
        exportLists(survey, SurveyList::Sigmf, path("sigmf"));
        for (const char *name :
             {"raven/night/a.wav.selections.txt", "audacity/night/a.wav.txt", "sigmf/night/a.wav.sigmf-meta"}) {
            RecordingInfo info;
            info.sampleRateHz = 8000.0;
            const std::vector<Annotation> read = readAnnotations(path(name), info);
            QCOMPARE(read.size(), std::size_t(2));
            QCOMPARE(read[1].startSeconds, 5.0);
            QCOMPARE(read[1].lowHz.value_or(0.0), 0.25);
            QCOMPARE(read[1].label, std::string("event 1"));
        }
    }

    void nothingIsWrittenOutside()
    {
        const std::string file = written("s.sqlite", {outcomeOf(path("a.wav"))});
        change(file, "UPDATE recordings SET path = '../../../../../escaped.wav'");
        SurveyDatabase survey(file);
        QDir().mkpath(m_folder->filePath("out"));
        exportLists(survey, SurveyList::Raven, path("out"));
        int count = 0;
        for (const auto &entry : std::filesystem::recursive_directory_iterator(path("out")))
            count += entry.is_regular_file() ? 1 : 0;
        QCOMPARE(count, 1);
        QCOMPARE(pathBelow("/x/../y/b.wav", "/z/s.sqlite"), std::string("x/y/b.wav"));
    }

    void stoneSoupByTime()
    {
        SurveyOutcome early = outcomeOf(path("z.wav"));
        early.recording.startUnixSeconds = 1.0;
        SurveyOutcome unknown = outcomeOf(path("u.wav"));
        unknown.recording.startUnixSeconds.reset();
        SurveyDatabase survey(written("s.sqlite", {outcomeOf(path("a.wav")), early, unknown}));
        QVERIFY(contains(errorOf([&] { exportStoneSoup(survey, path("t.csv"), std::nullopt); }),
                         "1 recording(s) have no start time"));
        QVERIFY(!QFile::exists(m_folder->filePath("t.csv")));
        exportStoneSoup(survey, path("t.csv"), 100.0);
        QCOMPARE(readBytes(path("t.csv")),
                 QByteArray("time,frequency_hz,track,recording,t,statistic,snr_db\n"
                            "1970-01-01T00:00:01.1Z,0.14285714285714285,3-2,\"z.wav\",0.1,2.5,-3\n"
                            "1970-01-01T00:00:06Z,0.3,3-1,\"z.wav\",5,1.5,\n"
                            "1970-01-01T00:01:40.1Z,0.14285714285714285,2-2,\"u.wav\",0.1,2.5,-3\n"
                            "1970-01-01T00:01:45Z,0.3,2-1,\"u.wav\",5,1.5,\n"
                            "2023-11-14T22:13:20.1Z,0.14285714285714285,1-2,\"a.wav\",0.1,2.5,-3\n"
                            "2023-11-14T22:13:25Z,0.3,1-1,\"a.wav\",5,1.5,\n"));
    }

    void camtrap()
    {
        SurveyDatabase survey(written("s.sqlite", {outcomeOf(path("night/a.wav")), outcomeOf(path("b.wav"))}));
        exportCamtrap(survey, path("package"), {52.5, -3.25, {}});
        const Json package = readJsonFile(path("package/datapackage.json"));
        QCOMPARE(package["resources"].size(), std::size_t(3));
        QCOMPARE(package["temporal"]["start"].get<std::string>(), std::string("2023-11-14"));
        QVERIFY(readBytes(path("package/deployments.csv"))
                    .contains("\n\"night\",,,\"52.5\",\"-3.25\",,\"2023-11-14T22:13:20Z\",\"2023-11-14T22:13:50Z\","));
        QVERIFY(
            readBytes(path("package/media.csv"))
                .contains("\n\"night/a.wav\",\"night\",,\"2023-11-14T22:13:20Z\",\"night/a.wav\",\"false\",\"a.wav\","
                          "\"audio/wav\",,,\n"));
        // Every byte of the longest table: one row an event, and each recording's after those of the one before.
        QByteArray observations =
            "observationID,deploymentID,mediaID,eventID,eventStart,eventEnd,observationLevel,"
            "observationType,cameraSetupType,scientificName,count,lifeStage,sex,behavior,"
            "individualID,individualPositionRadius,individualPositionAngle,individualSpeed,bboxX,"
            "bboxY,bboxWidth,bboxHeight,classificationMethod,classifiedBy,classificationTimestamp,"
            "classificationProbability,observationTags,observationComments\n";
        for (const auto &[recording, deployment] :
             {std::pair("b.wav", "recordings"), std::pair("night/a.wav", "night")})
            for (const auto &[event, start, end, onset, offset] :
                 {std::tuple(2, "20", "22", "0.1", "2.1"), std::tuple(1, "25", "27", "5", "7")})
                observations +=
                    QString("\"%1#%3\",\"%2\",\"%1\",\"%1#%3\",\"2023-11-14T22:13:%4Z\","
                            "\"2023-11-14T22:13:%5Z\",\"media\",\"unclassified\",,,,,,,,,,,,,,,\"machine\","
                            "\"Faintline %8\",,,\"f_low:0.25 | f_high:0.5 | "
                            "f:0.30000000000000004 | drift_hz_per_s:-1e-17 | statistic:1e+300 | t_onset:%6 | "
                            "t_end:%7\",\"\"\n")
                        .arg(recording)
                        .arg(deployment)
                        .arg(event)
                        .arg(start)
                        .arg(end)
                        .arg(onset)
                        .arg(offset)
                        .arg(QString::fromStdString(survey.origin().version))
                        .toUtf8();
        QCOMPARE(readBytes(path("package/observations.csv")), observations);
    }

private:
    std::string path(const std::string &name) const
    {
        return m_folder->filePath(QString::fromStdString(name)).toStdString();
    }
    /// A finished survey of these.
    std::string written(const std::string &name, const std::vector<SurveyOutcome> &outcomes,
                        const std::string &shard = {}) const
    {
        const std::string whole = path(name);
        const SurveyOrigin origin = originOf({}, shard);
        beginSurvey(origin, whole);
        SurveyDatabase database(whole, Sqlite::Access::Write);
        for (const SurveyOutcome &outcome : outcomes) {
            database.begin();
            database.put(outcome);
            database.commit();
        }
        writeSurvey({&database}, origin, whole);
        return whole;
    }
    void change(const std::string &file, const std::string &sql) const
    {
        Sqlite database(file, Sqlite::Access::Write);
        database.execute(sql);
    }

    std::unique_ptr<QTemporaryDir> m_folder;
};

FAINTLINE_TEST(tst_SurveyDatabase)
#include "tst_SurveyDatabase.moc"
