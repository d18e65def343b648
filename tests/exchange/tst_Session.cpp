#include "analyse/analyse.h"
#include "exchange/Session.h"
#include "support/test.h"

#include "base/Random.h"
#include "noise/openFrames.h"
#include "support/errors.h"

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
    session.source.path = recording.toStdString();
    return session;
}

/// What reading says, "" if nothing.
std::string refusal(const QString &path)
{
    return test::errorOf([&] { readSession(path.toStdString()); });
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
        session.source = {path("data/a.raw").toStdString(), {true, "ri16_le", 48000.0, 2, 4}, {}};
        session.settings.model.snr = 0.7;
        session.settings.decide.by = DecideSettings::By::Nats;
        session.view = {{"seconds", {1.5, 2.5}}, {"hz", {-100.25, 100.0}}};
        writeSession(path("sessions/s.faintline").toStdString(), session);

        const Session back = readSession(path("sessions/s.faintline").toStdString());
        QCOMPARE(back.source.path, path("data/a.raw").toStdString());
        QVERIFY(back.source.options.iq);
        QCOMPARE(back.source.options.rawType, std::string("ri16_le"));
        QCOMPARE(back.source.options.rawRateHz, 48000.0);
        QCOMPARE(back.source.options.rawChannels, 2);
        QCOMPARE(back.source.options.rawHeaderBytes, Index(4));
        QCOMPARE(back.settings, session.settings);
        QVERIFY(back.view == session.view);
        QCOMPARE(back.recordingHash.size(), std::size_t(64));
        QCOMPARE(recordingMismatch(back), std::string());
    }

    void movesWithItsRecording()
    {
        QVERIFY(QDir(m_folder.path()).mkpath("old"));
        writeFile(path("old/a.raw"), "0123");
        writeSession(path("old/s.faintline").toStdString(), sessionOf(path("old/a.raw")));
        QVERIFY(QDir(m_folder.path()).rename("old", "new"));
        QCOMPARE(readSession(path("new/s.faintline").toStdString()).source.path, path("new/a.raw").toStdString());
    }

    /// Power in a file over time and frequency, analysed with settings of its noise and of its part.
    void powerIsNormalisedAsTheSettingsAsk()
    {
        QByteArray header = "{'descr': '<f4', 'fortran_order': False, 'shape': (60, 40), }";
        header = header.leftJustified(128 - 10 - 1, ' ') + '\n';
        QByteArray bytes = QByteArray("\x93NUMPY\x01\x00", 8) + char(header.size()) + '\0' + header;
        Random random(131, 0);
        for (int i = 0; i < 60 * 40; ++i) {
            const auto value = float(random.exponential());
            bytes.append(reinterpret_cast<const char *>(&value), sizeof value);
        }
        writeFile(path("p.npy"), bytes);
        writeFile(path("p.grid.json"), R"({"values": "power", "time": {"step": 0.5},
            "axes": [{"name": "frequency", "unit": "Hz", "first": 100, "step": 2}]})");
        const std::string file = path("p.npy").toStdString();
        AnalysisSettings settings;
        settings.detector = EnergySettings{};
        settings.noise.halfWidthCells = 4;
        settings.selection.fromSeconds = 5.0;
        const OpenedSource opened = openSource(sourceOf(file));
        QVERIFY(opened.isPower);
        const auto analysis = analyse(opened, settings);
        const auto wanted = openFrames(file, {settings.selection, settings.noise});
        const auto valuesOf = [](const NormalisedFrames &frames) {
            std::vector<float> y(std::size_t(frames.time().count * frames.grid().size()));
            frames.read(0, frames.time().count, y);
            return y;
        };
        QCOMPARE(analysis->time(), wanted->time());
        QVERIFY(valuesOf(*analysis->frames) == valuesOf(*wanted));
        QVERIFY(opened.isNormalisedFor(AnalysisSettings()));
        QVERIFY(valuesOf(*analyse(opened, AnalysisSettings())->frames) == valuesOf(*opened.frames));
    }

    void noticesAnotherRecording()
    {
        writeFile(path("b.raw"), "0123");
        writeSession(path("b.faintline").toStdString(), sessionOf(path("b.raw")));
        writeFile(path("b.raw"), "0124");
        QVERIFY(!recordingMismatch(readSession(path("b.faintline").toStdString())).empty());
    }

    void aScenarioIsWrittenOut()
    {
        Session session;
        writeFile(path("scene.json"),
                  R"({"sampleRateHz": 100, "durationSeconds": 10, "lines": [{"frequencyHz": 20}]})");
        session.source = sourceOf(path("scene.json").toStdString());
        QVERIFY(session.source.scene);
        writeSession(path("scenario.faintline").toStdString(), session);
        const Session back = readSession(path("scenario.faintline").toStdString());
        QCOMPARE(*back.source.scene, *session.source.scene);
        QCOMPARE(back.source.path, std::string("scene.json"));
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
        QVERIFY(refused(R"({"faintline": 1, "recording": {"path": "a"}, "extra": 1})").contains("extra"));
        QVERIFY(!refusal(path("missing.faintline")).empty());
    }
};

FAINTLINE_TEST(tst_Session)
#include "tst_Session.moc"
