#include "app/cli/CommandLineTest.h"
#include "base/Random.h"
#include "support/test.h"

#include "exchange/survey/SurveyDatabase.h"
#include "exchange/survey/carryOutSurvey.h"

#include <cmath>
#include <numbers>

using namespace faintline;
using namespace faintline::test;

/// `survey`: what it finds in each recording is what `detect` finds, and its file has the same bytes whatever happened
/// on the way.
class tst_cliSurvey : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QVERIFY2(QFile::exists(program), "faintline-cli is not built");
        for (const char *name : {"night/b", "night/a", "night/.hidden", "many"})
            QVERIFY(QDir(folder()).mkpath(name));
        simulate("night/one.wav", 1);
        simulate("night/a/two.wav", 2);
        simulate("night/b/three.flac", 3);
        simulate("night/b/four.sigmf-meta", 4);
        writeBytes(pathOf("night/notes.txt"), "not a recording");
        writeBytes(pathOf("night/._one.wav"), "what a file manager left");
        writeBytes(pathOf("night/.hidden/five.wav"), "");
        const Outcome first = survey("first.sqlite");
        QCOMPARE(first.err, QByteArray());
        QCOMPARE(first.out, QByteArray());
        QCOMPARE(first.code, 0);
        QStringList files(QDir(folder()).entryList({"first*"}));
        QCOMPARE(files, QStringList{"first.sqlite"}); // and nothing beside it
    }

    void eventsAreThoseOfDetect()
    {
        QCOMPARE(run({"survey", "export", "first.sqlite", "--events", "all.csv", "--tracks", "tracks.csv"}).code, 0);
        QStringList names;
        for (const SurveyRecording &one : database("first.sqlite").recordings())
            names << QDir(folder()).relativeFilePath(QString::fromStdString(one.file.path));
        QCOMPARE(names,
                 (QStringList{"night/a/two.wav", "night/b/four.sigmf-meta", "night/b/three.flac", "night/one.wav"}));
        for (const QString &name : names) {
            const Outcome found =
                run(QStringList{"detect", name, "--events", "e.csv", "--tracks", "t.csv"} + lineSettings);
            QCOMPARE(found.code, 0);
            QVERIFY(content("e.csv").count('\n') >= 2);
            QCOMPARE(rowsOf(content("all.csv"), name.toUtf8(), 2, 13), rowsOf(content("e.csv"), {}, 0, 13));
            QCOMPARE(rowsOf(content("tracks.csv"), name.toUtf8(), 1, 8), rowsOf(content("t.csv"), {}, 0, 8));
        }
    }

    /// A sample every two seconds, 20 and 40 hours of them: one false alarm in the length of each, as `detect` has it.
    void slowRecordingsHaveAnOrderOfTheirOwn()
    {
        QVERIFY(QDir(folder()).mkpath("slow"));
        const QStringList window{"--set", "spectrogram.windowSeconds=200"};
        for (const int hours : {20, 40}) {
            std::vector<float> samples(std::size_t(hours) * 1800);
            Random(5, std::uint64_t(hours)).normals(samples, 1.0f);
            for (std::size_t i = 0; i < samples.size(); ++i)
                samples[i] += float(std::cos(2.0 * std::numbers::pi * 0.2 * double(i)));
            const std::string name = pathOf("slow/") + std::to_string(hours);
            writeBytes(name + ".sigmf-data", QByteArray(reinterpret_cast<const char *>(samples.data()),
                                                        qsizetype(sizeof(float) * samples.size())));
            writeBytes(name + ".sigmf-meta", R"({"global": {"core:datatype": "rf32_le", "core:sample_rate": 0.5,
            "core:version": "1.0.0"}, "captures": [{"core:sample_start": 0}], "annotations": []})");
        }
        QCOMPARE(run(QStringList{"survey", "slow", "--out", "slow.sqlite"} + window).code, 0);
        QCOMPARE(run({"survey", "export", "slow.sqlite", "--events", "slow.csv"}).code, 0);
        const std::vector<SurveyRecording> recordings = database("slow.sqlite").recordings();
        QCOMPARE(recordings.size(), std::size_t(2));
        for (const SurveyRecording &one : recordings) {
            QCOMPARE(settingsFromJson(one.settings, "slow").decide.falseAlarmsPerHour, 3600.0 / *one.durationSeconds);
            const QString name = QDir(folder()).relativeFilePath(QString::fromStdString(one.file.path));
            QCOMPARE(run(QStringList{"detect", name, "--events", "e.csv"} + window).code, 0);
            QVERIFY(content("e.csv").count('\n') >= 2);
            QCOMPARE(rowsOf(content("slow.csv"), name.toUtf8(), 2, 13), rowsOf(content("e.csv"), {}, 0, 13));
        }
        const QStringList asked{"--set", "decide.falseAlarmsPerHour=0.5"};
        QCOMPARE(run(QStringList{"survey", "slow", "--out", "asked.sqlite"} + window + asked).code, 0);
        for (const SurveyRecording &one : database("asked.sqlite").recordings())
            QCOMPARE(settingsFromJson(one.settings, "asked").decide.falseAlarmsPerHour, 0.5);
    }

    void sameBytesWhateverTheShards()
    {
        const QByteArray whole = content("first.sqlite");
        QVERIFY(whole.size() > 1000);
        QCOMPARE(survey("jobs.sqlite", {"--jobs", "3", "--threads", "1"}).code, 0);
        QCOMPARE(content("jobs.sqlite"), whole);
        QCOMPARE(survey("p1.sqlite", {"--shard", "1/3"}).code, 0);
        QCOMPARE(survey("p0.sqlite", {"--shard", "3/3"}).code, 0); // the same as 0/3
        QCOMPARE(survey("p2.sqlite", {"--shard", "2/3"}).code, 0);
        QCOMPARE(run({"survey", "merge", "p1.sqlite", "p2.sqlite", "p0.sqlite", "--out", "merged.sqlite"}).code, 0);
        QCOMPARE(content("merged.sqlite"), whole);
        const Outcome missing = run({"survey", "merge", "p1.sqlite", "p2.sqlite", "--out", "half.sqlite"});
        QCOMPARE(missing.code, 2);
        QCOMPARE(missing.err, QByteArray("error: half.sqlite: shard 0/3 is missing\n"));
        // Once more: nothing is left to do, and nothing is written.
        const QDateTime before = QFileInfo(path("first.sqlite")).lastModified();
        QCOMPARE(survey("first.sqlite").code, 0);
        QCOMPARE(QFileInfo(path("first.sqlite")).lastModified(), before);
    }

    void killedIsResumed()
    {
        for (int i = 0; i < many; ++i)
            QVERIFY(QFile::copy(path("night/one.wav"), path(QString("many/%1.wav").arg(i, 3, 10, QChar('0')))));
        QCOMPARE(survey("undisturbed.sqlite", {"--threads", "2"}, "many").code, 0);
        int left = many;
        for (const double reached : {0.2, 0.5, 0.8}) {
            QProcess process;
            runUntil(process, "killed.sqlite", {"--threads", "2"}, reached);
            process.kill();
            QVERIFY(process.state() == QProcess::NotRunning || process.waitForFinished(patience));
            if (!QFile::exists(path("killed.sqlite")))
                continue; // it had not begun
            SurveyDatabase database(pathOf("killed.sqlite"));
            const int now = many - int(database.recordings().size());
            QVERIFY(now <= left);
            left = now;
        }
        QVERIFY(left < many);
        const Outcome last = survey("killed.sqlite", {}, "many");
        QCOMPARE(last.err, QByteArray());
        QCOMPARE(last.code, 0);
        QCOMPARE(content("killed.sqlite"), content("undisturbed.sqlite"));
        QCOMPARE(QDir(folder()).entryList({"killed*"}), QStringList{"killed.sqlite"});
    }

    void endsWithinASecond()
    {
        QProcess process;
        runUntil(process, "stopped.sqlite", {"--jobs", "1"}, 0.3);
        if (process.state() == QProcess::NotRunning)
            QSKIP("it was faster");
        process.terminate();
        QElapsedTimer timer;
        timer.start();
        QVERIFY(process.waitForFinished(patience));
        const qint64 elapsed = timer.elapsed();
        QVERIFY2(elapsed < 1000 * slowdown, qPrintable(QString("it took %1 ms").arg(elapsed)));
        if (process.exitCode() == 0)
            QSKIP("it was faster");
        QCOMPARE(process.exitCode(), 1);
        SurveyDatabase database(pathOf("stopped.sqlite"));
        QVERIFY(!database.isFinished());
        const int kept = int(database.recordings().size());
        QVERIFY(kept >= many * 3 / 10 - 2 && kept < many);
    }

    void changedAndTouchedFiles()
    {
        QVERIFY(QDir(folder()).mkpath("changing"));
        QVERIFY(QFile::copy(path("night/one.wav"), path("changing/a.wav")));
        QVERIFY(QFile::copy(path("night/a/two.wav"), path("changing/b.wav")));
        QCOMPARE(survey("changing.sqlite", {}, "changing").code, 0);
        simulate("changing/a.wav", 9);
        QFile touched(path("changing/b.wav"));
        QVERIFY(touched.open(QIODevice::ReadWrite)
                && touched.setFileTime(QDateTime::currentDateTime().addDays(-1), QFileDevice::FileModificationTime));
        touched.close();
        QVERIFY(QFile::copy(path("night/one.wav"), path("changing/c.wav"))); // and one more
        QCOMPARE(survey("changing.sqlite", {}, "changing").code, 0);
        QCOMPARE(survey("fresh.sqlite", {}, "changing").code, 0);
        QCOMPARE(content("changing.sqlite"), content("fresh.sqlite"));
        QCOMPARE(database("fresh.sqlite").recordings().size(), std::size_t(3));
    }

    void whatIsAwayKeepsItsRows_data()
    {
        QTest::addColumn<QString>("recording");
        QTest::addColumn<QString>("away");
        QTest::newRow("a file") << "away/a.wav"
                                << "away/a.wav";
        QTest::newRow("one of two files") << "away/b.sigmf-meta"
                                          << "away/b.sigmf-data";
    }

    void whatIsAwayKeepsItsRows()
    {
        QFETCH(QString, recording);
        QFETCH(QString, away);
        QVERIFY(QDir(folder()).mkpath("away"));
        simulate(recording, 4);
        QCOMPARE(survey("away.sqlite", {}, recording).code, 0);
        const std::string file = path(recording).toStdString();
        const SurveySettings settings = settingsOf(database("away.sqlite").origin(), "away.sqlite");
        const SurveyEvent reviewed = database("away.sqlite").events(1).front();
        SurveyDatabase(pathOf("away.sqlite"), Sqlite::Access::Write)
            .setReview(file, reviewed.event, Verdict::Accepted, "");
        QVERIFY(QFile::remove(path(away)));
        int warnings = 0;
        const SurveyTally tally = carryOutSurvey({settings, {file}, {}, 1}, pathOf("away.sqlite"), {},
                                                 [&](const std::string &, const std::string &) { ++warnings; });
        QCOMPARE(tally.failed, 1);
        QCOMPARE(warnings, 1);
        QVERIFY(database("away.sqlite").recordings().front().isAnalysed());
        QCOMPARE(database("away.sqlite").events(1).front().box.verdict, Verdict::Accepted);
        QVERIFY(QFile::remove(path("away.sqlite")));
    }

    void unreadableFilesAreRows()
    {
        QVERIFY(QDir(folder()).mkpath("broken"));
        QVERIFY(QFile::copy(path("night/one.wav"), path("broken/good.wav")));
        writeBytes(pathOf("broken/bad.wav"), "no sound");
        writeBytes(pathOf("broken/lone.sigmf-meta"), "{}");
        const Outcome half = survey("broken.sqlite", {}, "broken");
        QCOMPARE(half.code, 1);
        QCOMPARE(half.err.count("warning: "), qsizetype(2));
        QVERIFY(
            half.err.contains("error: broken.sqlite: 2 recording(s) could not be analysed and 0 folder(s) could not be "
                              "read; 1 recording(s) were analysed"));
        std::vector<SurveyRecording> rows = database("broken.sqlite").recordings();
        QCOMPARE(rows.size(), std::size_t(3));
        QVERIFY(!rows[0].isAnalysed() && rows[1].isAnalysed() && !rows[2].isAnalysed());
        QVERIFY(!rows[0].reason.empty() && !contains(rows[0].reason, "\n"));
        // Repaired, they are analysed.
        QVERIFY(QFile::remove(path("broken/lone.sigmf-meta")) && QFile::remove(path("broken/bad.wav")));
        QVERIFY(QFile::copy(path("night/one.wav"), path("broken/bad.wav")));
        QCOMPARE(survey("broken.sqlite", {}, "broken").code, 0);
        rows = database("broken.sqlite").recordings();
        QVERIFY(rows[0].isAnalysed());
    }

    void exports()
    {
        QVERIFY(QFile::copy(path("first.sqlite"), path("reviewed.sqlite")));
        SurveyDatabase survey(pathOf("reviewed.sqlite"), Sqlite::Access::Write);
        const SurveyRecording one = survey.recordings().back();
        QCOMPARE(one.file.path, pathOf("night/one.wav"));
        const std::vector<SurveyEvent> events = survey.events(one.id);
        QVERIFY(!events.empty());
        for (const SurveyEvent &event : events)
            survey.setReview(one.file.path, event.event, Verdict::Accepted, "");
        const Outcome made = run({"survey", "export", "reviewed.sqlite", "--stone-soup", "s.csv", "--start",
                                  "2024-07-26T00:00:00Z", "--raven", "raven", "--audacity", "audacity", "--sigmf",
                                  "sigmf", "--camtrap", "package", "--latitude", "52", "--longitude", "13"});
        QCOMPARE(made.err, QByteArray());
        QCOMPARE(made.code, 0);
        QVERIFY(content("s.csv").contains("\n2024-07-26T00:00:0"));
        for (const char *name : {"raven/night/one.wav.selections.txt", "audacity/night/b/three.flac.txt",
                                 "sigmf/night/b/four.sigmf-meta.sigmf-meta", "package/observations.csv"})
            QVERIFY2(!content(name).isEmpty(), name);
        // A list that is read back as annotations reviews the same events.
        const Outcome judged =
            run(QStringList{"detect", "night/one.wav", "--annotations", "raven/night/one.wav.selections.txt",
                            "--events", "judged.csv", "--summary"}
                + lineSettings);
        QCOMPARE(judged.code, 0);
        const QString line = QString("%1 annotation(s), %1 event(s) reviewed by them\n").arg(events.size());
        QVERIFY2(QString::fromUtf8(judged.out).contains(line), judged.out.constData());
    }

    void mistakes_data()
    {
        QTest::addColumn<QStringList>("arguments");
        QTest::addColumn<QByteArray>("complaint");
        const auto row = [](const char *name, const QStringList &arguments, const char *complaint) {
            QTest::newRow(name) << QStringList{"survey"} + arguments << QByteArray("error: ") + complaint;
        };
        row("nothing", {}, "survey: requires folders or recordings, and --out\n");
        row("no output", {"night"}, "survey: requires folders or recordings, and --out\n");
        row("no such folder", {"nowhere", "--out", "x.sqlite"}, "nowhere: there is no such file or folder\n");
        row("no recordings", {"night/.hidden/..", "--out", "x.sqlite", "--raw-type", "ci16_le", "--raw-rate", "1"},
            "night/.hidden/..: contains no recordings\n");
        row("no folder for it", {"night", "--out", "nowhere/x.sqlite"}, "nowhere/x.sqlite: cannot be written:");
        row("a recording as output", {"night", "--out", "night/one.wav"},
            "night/one.wav: is an input and would be replaced;");
        row("other settings", {"night", "--out", "first.sqlite"}, "first.sqlite: is a survey with other settings: ");
        row("shard of a whole", QStringList{"night", "--out", "first.sqlite", "--shard", "1/2"} + lineSettings,
            "first.sqlite: contains a whole survey, not shard 1/2;");
        row("shard", {"night", "--out", "x.sqlite", "--shard", "3/2"}, "--shard 3/2: must be I/N");
        row("setting", {"night", "--out", "x.sqlite", "--set", "no.such=1"}, "no.such");
        row("export nothing", {"export", "first.sqlite"}, "survey export: no output requested;");
        row("export of none", {"export", "night/one.wav", "--events", "x.csv"},
            "night/one.wav: is not an SQLite database\n");
        row("export to", {"export", "first.sqlite", "--events", "x.txt"}, "x.txt: must end in .csv\n");
        row("no place", {"export", "first.sqlite", "--camtrap", "x"},
            "--camtrap: requires --latitude and --longitude\n");
        row("no date", {"export", "first.sqlite", "--stone-soup", "x.csv"},
            "first.sqlite: 4 recording(s) have no start time, which Stone Soup requires; give --start");
        row("start", {"export", "first.sqlite", "--stone-soup", "x.csv", "--start", "noon"},
            "--start noon: must be a date");
    }

    void mistakes()
    {
        QFETCH(QStringList, arguments);
        QFETCH(QByteArray, complaint);
        const QByteArray before = content("first.sqlite");
        const Outcome refused = run(arguments);
        QVERIFY2(refused.err.startsWith(complaint), refused.err.constData());
        QCOMPARE(refused.err.count('\n'), qsizetype(1));
        QCOMPARE(refused.code, 2);
        QCOMPARE(content("first.sqlite"), before);
        QVERIFY(QDir(folder()).entryList({"x*"}).isEmpty());
    }

private:
    static constexpr int many = 200; ///< recordings in the folder of that name

    /// Runs a survey of `folder` into `out`.
    Outcome survey(const QString &out, const QStringList &more = {},
                   const QString &from = QStringLiteral("night")) const
    {
        return run(QStringList{"survey", from, "--out", out} + lineSettings + more);
    }
    /// Runs a survey of `many` until it says that this much of it is done, or to its end where it is quicker.
    void runUntil(QProcess &process, const QString &out, const QStringList &more, double reached) const
    {
        process.setWorkingDirectory(folder());
        process.setReadChannel(QProcess::StandardError);
        process.start(program, QStringList{"survey", "many", "--out", out, "--progress", "json"} + lineSettings + more);
        static const QRegularExpression progress("\"progress\": ([0-9.]+)[^0-9.]");
        QString said;
        double done = 0.0;
        while (done < reached && process.waitForReadyRead(patience)) {
            said += QString::fromUtf8(process.readAll());
            for (const QRegularExpressionMatch &match : progress.globalMatch(said))
                done = match.captured(1).toDouble();
        }
    }
    /// A recording with a line at its own frequency.
    void simulate(const QString &name, int seed) const
    {
        writeBytes(pathOf("one.json"),
                   QByteArray(R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "seed": %1,
            "lines": [{"snrDb": 9, "referenceSeconds": 0.5, "startSeconds": 4, "durationSeconds": 12,
                       "frequencyHz": 1%2}]})")
                       .replace("%1", QByteArray::number(seed))
                       .replace("%2", QByteArray::number(10 + seed % 80)));
        const Outcome made = run({"simulate", "one.json", "--out", name});
        QCOMPARE(made.err, QByteArray());
        QCOMPARE(made.code, 0);
    }
    SurveyDatabase database(const char *name) const { return SurveyDatabase(pathOf(name)); }
    /// Columns of the rows of an exported table that belong to a recording; of all rows if that has no name. `detect`
    /// has more columns than a survey, behind these.
    QByteArray rowsOf(const QByteArray &table, const QByteArray &recording, int columnsBefore, int columns) const
    {
        QByteArray rows;
        for (const QByteArray &line : table.mid(table.indexOf('\n') + 1).split('\n'))
            if (!line.isEmpty() && (recording.isEmpty() || line.startsWith('"' + recording + '"')))
                rows += line.split(',').mid(columnsBefore, columns).join(',') + '\n';
        return rows;
    }
};

FAINTLINE_TEST(tst_cliSurvey)
#include "tst_cliSurvey.moc"
