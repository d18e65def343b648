#include "app/document/Session.h"

#include "support/errors.h"

#include <QDir>
#include <QFile>
#include <QTemporaryDir>
#include <QTest>

using namespace faintline;

namespace {

void writeFile(const QString &path, const QByteArray &bytes)
{
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(bytes);
}

Session sessionOf(const QString &recording)
{
    Session session;
    session.source.path = recording;
    return session;
}

/// What reading says, "" if nothing.
std::string refusal(const QString &path)
{
    return test::errorOf([&] { readSession(path); });
}

} // namespace

class tst_Session : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    QString path(const QString &name) const { return m_folder.filePath(name); }

private slots:
    void comesBackAsItWas()
    {
        QVERIFY(QDir(m_folder.path()).mkpath("sessions"));
        QVERIFY(QDir(m_folder.path()).mkpath("data"));
        writeFile(path("data/a.raw"), "0123456789abcdef");
        Session session;
        session.source = {path("data/a.raw"), {true, "ri16_le", 48000.0, 2, 4}, {}};
        session.settings.model.snr = 0.7;
        session.settings.decide.by = DecideSettings::By::Nats;
        session.view.visible = {{1.5, 2.5}, {-100.25, 100.0}};
        session.view.cursor = {2.0, 0.1};
        session.view.orientation = "leftToRight";
        session.view.isLogarithmic = session.view.isRadioAxis = true;
        session.view.colourMap = "viridis";
        writeSession(path("sessions/s.faintline"), session);

        const Session back = readSession(path("sessions/s.faintline"));
        QCOMPARE(back.source.path, path("data/a.raw"));
        QVERIFY(back.source.options.iq);
        QCOMPARE(back.source.options.rawType, std::string("ri16_le"));
        QCOMPARE(back.source.options.rawRateHz, 48000.0);
        QCOMPARE(back.source.options.rawChannels, 2);
        QCOMPARE(back.source.options.rawHeaderBytes, Index(4));
        QCOMPARE(back.settings, session.settings);
        QVERIFY(back.view.visible == session.view.visible);
        QVERIFY(back.view.cursor == session.view.cursor);
        QCOMPARE(back.view.orientation, session.view.orientation);
        QVERIFY(back.view.isLogarithmic && back.view.isRadioAxis);
        QCOMPARE(back.view.colourMap, session.view.colourMap);
        QCOMPARE(back.recordingHash.size(), std::size_t(64));
        QCOMPARE(recordingMismatch(back), QString());
    }

    void movesWithItsRecording()
    {
        QVERIFY(QDir(m_folder.path()).mkpath("old"));
        writeFile(path("old/a.raw"), "0123");
        writeSession(path("old/s.faintline"), sessionOf(path("old/a.raw")));
        QVERIFY(QDir(m_folder.path()).rename("old", "new"));
        QCOMPARE(readSession(path("new/s.faintline")).source.path, path("new/a.raw"));
    }

    void noticesAnotherRecording()
    {
        writeFile(path("b.raw"), "0123");
        writeSession(path("b.faintline"), sessionOf(path("b.raw")));
        writeFile(path("b.raw"), "0124");
        QVERIFY(!recordingMismatch(readSession(path("b.faintline"))).isEmpty());
    }

    void aScenarioIsWrittenOut()
    {
        Session session;
        session.source = sourceOf(":/scenarios/faint-drifting-line.json");
        QVERIFY(session.source.scene);
        writeSession(path("scenario.faintline"), session);
        const Session back = readSession(path("scenario.faintline"));
        QCOMPARE(*back.source.scene, *session.source.scene);
        QCOMPARE(back.source.name(), "faint-drifting-line.json");
    }

    void refusalsNameTheFileAndTheKey()
    {
        const auto refused = [this](const QByteArray &text) {
            writeFile(path("bad.faintline"), text);
            return QString::fromStdString(refusal(path("bad.faintline")));
        };
        QVERIFY(refused("{").startsWith(path("bad.faintline")));
        QVERIFY(refused("[]").startsWith(path("bad.faintline")));
        QVERIFY(refused(R"({"faintline": 99, "recording": {"path": "a"}})").contains("faintline"));
        QVERIFY(refused(R"({"faintline": 1})").contains("recording"));
        QVERIFY(refused(R"({"faintline": 1, "recording": {"path": 3}})").startsWith(path("bad.faintline")));
        QVERIFY(refused(R"({"faintline": 1, "recording": {"path": "a"}, "settings": {"model.snr": -3}})")
                    .contains("model.snr"));
        QVERIFY(refused(R"({"faintline": 1, "recording": {"path": "a"}, "view": {"cursor": [1]}})")
                    .startsWith(path("bad.faintline")));
        QVERIFY(refused(R"({"faintline": 1, "recording": {"path": "a"}, "extra": 1})").contains("extra"));
        QVERIFY(!refusal(path("missing.faintline")).empty());
    }
};

QTEST_GUILESS_MAIN(tst_Session)
#include "tst_Session.moc"
