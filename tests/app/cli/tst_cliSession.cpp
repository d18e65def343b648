#include "analyse/analyse.h"
#include "app/cli/CommandLineTest.h"
#include "support/test.h"

#include "analyse/events.h"
#include "base/json.h"
#include "exchange/Session.h"
#include "exchange/writeReviewed.h"

using namespace faintline;
using namespace faintline::test;

/// A session in the place of a recording: its recording with the lines added to it, its settings and its reviews.
class tst_cliSession : public CommandLineTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        simulateLine();
        m_session.source = sourceOf(pathOf("line.wav"));
        m_session.source.injections = {{{LineSettings{.frequencyHz = 330.0}, 0.05}, 0, 5}};
        m_session.settings.spectrogram.windowSeconds = 0.5;
        m_session.settings.decide.falseAlarmsPerHour = 2.0;
        m_session.annotations.boxes = {{8.0, 23.0, 200.0, 220.0, "pump", "", Verdict::Accepted}};
        writeSession(pathOf("s.faintline"), m_session);
        m_note = "note: " + path("line.wav").toUtf8() + ": 1 known line(s) were injected into channel 0.\n";
    }

    void runsWholly()
    {
        const Outcome done = run({"detect", "s.faintline", "--events", "events.csv"});
        QCOMPARE(done.err, m_note);
        QCOMPARE(done.code, 0);
        const auto analysis = analyse(openSource(m_session.source), m_session.settings);
        const std::vector<Event> found = events(*analysis);
        QCOMPARE(found.size(), std::size_t(2)); // the line of the recording and the added one
        writeReviewed(*analysis, found, m_session.annotations, pathOf("expected.csv"));
        QCOMPARE(content("events.csv"), content("expected.csv"));
        QVERIFY(content("events.csv").contains("pump"));
        QCOMPARE(run({"replay", "events.csv"}).out, QByteArray("events.csv: the same bytes\n"));
        QVERIFY(run({"info", "s.faintline"}).out.contains("1 known line"));
        const Outcome why = run({"explain", "s.faintline", "--time", "15", "--frequency", "330"});
        QCOMPARE(why.code, 0);
    }

    void optionsCountAfterIt()
    {
        QCOMPARE(run({"detect", "s.faintline", "--high", "300", "--events", "low.json"}).code, 0);
        QCOMPARE(Json::parse(content("low.json").toStdString()).at("events").size(), std::size_t(2)); // with the box
    }

    /// The window's numbers of the events.
    void keepsItsNumbers()
    {
        const Json session = readJsonFile(pathOf("s.faintline"));
        Json numbered = session;
        numbered["numbers"] = Json::parse(
            R"([{"number": 7, "path": {"seconds": [8, 23], "position": [[210], [213]], "tolerance": [4]}}])");
        writeBytes(pathOf("numbered.faintline"), QByteArray::fromStdString(numbered.dump()));
        const Outcome done = run({"detect", "numbered.faintline", "--json"});
        QCOMPARE(done.err, m_note);
        std::map<int, double> places;
        const Json told = Json::parse(done.out.toStdString());
        for (const Json &event : told.at("events"))
            if (event.contains("event"))
                places[event["event"]] = event["f"];
        QCOMPARE(places.size(), std::size_t(2));
        QVERIFY(std::abs(places.at(7) - 211.5) < 3.0);
        QVERIFY(std::abs(places.at(8) - 330.0) < 3.0);
        QCOMPARE(readSession(pathOf("numbered.faintline")).numbers.areUsual(), false);
    }

    void simulates()
    {
        Session session;
        session.source = sourceOf(pathOf("scene.json"));
        session.settings = m_session.settings;
        writeSession(pathOf("scene.faintline"), session);
        QCOMPARE(run({"detect", "scene.faintline", "--tracks", "scene.csv"}).code, 0);
        QCOMPARE(run(QStringList{"detect", "scene.json", "--tracks", "plain.csv"} + lineSettings).code, 0);
        QCOMPARE(content("scene.csv"), content("plain.csv"));
    }

    void isRefused_data()
    {
        QTest::addColumn<QStringList>("options");
        QTest::addColumn<QByteArray>("words");
        QTest::newRow("I and Q") << QStringList{"--iq"} << QByteArray("leave out --iq");
        QTest::newRow("raw") << QStringList{"--raw-type", "ri16_le"} << QByteArray("leave out --iq and --raw");
        QTest::newRow("settings") << QStringList{"--session", "s.faintline"} << QByteArray("--session");
        QTest::newRow("timeline") << QStringList{"--timeline"} << QByteArray("--timeline");
    }

    void isRefused()
    {
        QFETCH(QStringList, options);
        QFETCH(QByteArray, words);
        const Outcome done = run(QStringList{"detect", "s.faintline", "--summary"} + options);
        QCOMPARE(done.code, 2);
        QCOMPARE(done.err.count('\n'), 1);
        QVERIFY2(done.err.contains(words), done.err.constData());
    }

    void aChangedRecordingIsNoted()
    {
        writeBytes(pathOf("moved.wav"), content("line.wav"));
        Session session = m_session;
        session.source.path = pathOf("moved.wav");
        writeSession(pathOf("moved.faintline"), session);
        QByteArray bytes = content("line.wav");
        bytes.back() = char(bytes.back() ^ 1);
        writeBytes(pathOf("moved.wav"), bytes);
        const Outcome done = run({"detect", "moved.faintline", "--summary"});
        QCOMPARE(done.code, 2);
        QVERIFY2(done.err.contains("moved.wav") && done.err.contains("has changed"), done.err.constData());
        QFile::remove(path("moved.wav"));
        QVERIFY(run({"detect", "moved.faintline", "--summary"}).err.contains("moved.wav"));
    }

private:
    Session m_session;
    QByteArray m_note; ///< on its recording
};

FAINTLINE_WINDOW_TEST(tst_cliSession)
#include "tst_cliSession.moc"
