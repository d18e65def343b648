#include "app/base/MessageBar.h"
#include "app/features/live/LiveBar.h"
#include "app/features/pictures/Playback.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "live/sources/SoundSource.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/PulseServer.h"
#include "support/find.h"
#include "support/recordings.h"
#include "support/test.h"

#include <QAction>
#include <QMenuBar>
#include <QToolButton>

#include <cstring>
#include <numbers>
#include <thread>

using namespace faintline;
using namespace faintline::test;

/// Play, in the window: what is heard is what was chosen, and the cursor is where the sound is.
class tst_Playback : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase();

    void withoutDeviceTheCursorMoves_data();
    void withoutDeviceTheCursorMoves();
    void theCursorFollowsTheSound();
    void theLineIsHeardAt700Hz();
    void whatComesInIsHeard();
    void startsAgainWhereTheCursorIsPut();

private:
    double cursor() const { return viewport().cursor()->seconds; }
    void pressSpace() { QTest::keyClick(m_window->workbench().output(), Qt::Key_Space); }
    Playback &playback() const { return *m_window->findChild<Playback *>(); }
    void choose(const QString &text) const;
    bool hasServer();

    std::unique_ptr<PulseServer> m_server;
};

namespace {

constexpr double deviceRate = 48'000.0;

/// At the sound server's other end.
class Ear
{
public:
    void hear(Index samples)
    {
        for (m_heard.clear(); std::ssize(m_heard) < samples; QCoreApplication::processEvents()) {
            const Heard some = m_source.hear(std::chrono::milliseconds(20));
            const std::size_t before = m_heard.size();
            m_heard.resize(before + some.bytes.size() / sizeof(float));
            if (!some.bytes.empty())
                std::memcpy(m_heard.data() + before, some.bytes.data(), some.bytes.size());
        }
    }

    /// In the last second.
    double amplitude(double hz) const
    {
        const auto second = Index(deviceRate);
        return 2.0 * std::abs(fourier(m_heard.data() + std::ssize(m_heard) - second, second, false, hz / deviceRate))
               / deviceRate;
    }

private:
    SoundSource m_source{{"default", {}, 0.0, 0}};
    std::vector<float> m_heard;
};

/// 2 kHz in real time, after sixteen seconds of it at once.
class Whistle final : public SampleSource
{
public:
    const StreamFormat &format() const override { return m_format; }
    Heard hear(std::chrono::milliseconds) override
    {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        const double due = 16.0 + 1e-3 * double(m_begun.elapsed());
        std::vector<float> samples(std::size_t(due * m_format.sampleRateHz) - m_count);
        Random(5, m_count).normals(samples, 0.02f);
        for (float &sample : samples)
            sample += float(0.3 * std::sin(2.0 * std::numbers::pi * 0.25 * double(m_count++ % 4)));
        Heard heard;
        const auto bytes = std::as_bytes(std::span(samples));
        heard.bytes.assign(bytes.begin(), bytes.end());
        return heard;
    }

private:
    StreamFormat m_format{parseSampleType("rf32_le", "test"), 8000.0, 1, 0.0, "whistle"};
    QElapsedTimer m_begun = [] {
        QElapsedTimer timer;
        timer.start();
        return timer;
    }();
    std::size_t m_count = 0;
};

} // namespace

void tst_Playback::initTestCase()
{
    qputenv("PULSE_SERVER", "unix:/nonexistent");
    LineScene scene;
    scene.sampleRateHz = 8000.0;
    scene.durationSeconds = 60.0;
    scene.lines = {{.snrDb = 25.0,
                    .referenceSeconds = 0.25,
                    .startSeconds = 5.0,
                    .durationSeconds = 50.0,
                    .frequencyHz = 2000.0,
                    .driftHzPerSecond = 1.0}};
    const QString path = m_folder.filePath("line.wav");
    writeRecording(SimulatedRecording(scene), path.toStdString());
    m_window = newWindow();
    QVERIFY(
        openAndSettle(*m_window, path, [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.25; }));
    QVERIFY(!m_window->document().shownEvents().empty());
}

/// An action of a submenu, by its text.
void tst_Playback::choose(const QString &text) const
{
    for (QAction *action : m_window->findChildren<QAction *>())
        if (action->text().remove('&') == text)
            return action->trigger();
    qFatal("there is no such action");
}

bool tst_Playback::hasServer()
{
    if (!m_server)
        m_server = std::make_unique<PulseServer>();
    return m_server->whyNot().isEmpty();
}

void tst_Playback::withoutDeviceTheCursorMoves_data()
{
    QTest::addColumn<QString>("what");
    QTest::newRow("line") << "Line of the event, or at the cursor, at 700 Hz";
    QTest::newRow("recording") << "Recording";
}

void tst_Playback::withoutDeviceTheCursorMoves()
{
    QFETCH(QString, what);
    if (!soundDevices().empty())
        QSKIP("this machine has a sound card");
    m_window->findChild<MessageBar *>()->hide();
    choose(what);
    viewport().setCursor({10.0, 2000.0});
    pressSpace();
    QTRY_VERIFY(cursor() > 10.5);
    const QString words = m_window->findChild<MessageBar *>()->text();
    QVERIFY2(words.contains("this machine has no sound output") && words.contains("the cursor moves without sound"),
             qPrintable(words));
    pressSpace();
    const double seconds = cursor();
    QTest::qWait(200);
    QCOMPARE(cursor(), seconds);
}

void tst_Playback::theCursorFollowsTheSound()
{
    if (!hasServer())
        QSKIP(qPrintable(m_server->whyNot()));
    viewport().setCursor({10.0, 2000.0});
    pressSpace();
    QVERIFY(playback().isPlaying());
    QTRY_VERIFY(cursor() > 10.1); // the device has begun
    const double begin = cursor();
    QElapsedTimer timer;
    timer.start();
    QTest::qWait(2000);
    QVERIFY2(std::abs(cursor() - begin - double(timer.elapsed()) / 1000.0) < 0.4,
             qPrintable(QString::number(cursor())));
    choose(tr("%1 × speed").arg(4.0));
    const double faster = cursor();
    QTRY_VERIFY(cursor() > faster + 0.5);
    const double from = cursor();
    timer.start();
    QTest::qWait(1500);
    const double rate = (cursor() - from) / (double(timer.elapsed()) / 1000.0);
    QVERIFY2(rate > 3.0 && rate < 5.0, qPrintable(QString::number(rate)));
    pressSpace();
    QVERIFY(!playback().isPlaying());
    choose(tr("%1 × speed").arg(1.0));
}

// Heard at the sound server's other end.
void tst_Playback::theLineIsHeardAt700Hz()
{
    if (!hasServer())
        QSKIP(qPrintable(m_server->whyNot()));
    Ear ear;
    ear.hear(1);
    viewport().setCursor({20.0, 2000.0});
    choose("Line of the event, or at the cursor, at 700 Hz");
    pressSpace();
    ear.hear(3 * 48'000);
    QVERIFY2(ear.amplitude(700.0) > 0.08, qPrintable(QString::number(ear.amplitude(700.0))));
    QVERIFY(ear.amplitude(2017.0) < 0.01);
    pressSpace();
    choose("Recording");
    viewport().setCursor({20.0, 2000.0});
    pressSpace();
    ear.hear(3 * 48'000);
    QVERIFY(ear.amplitude(700.0) < 0.02);
    pressSpace();
}

// A source that gives sound in real time, after sixteen seconds of it at once.
void tst_Playback::whatComesInIsHeard()
{
    if (!hasServer())
        QSKIP(qPrintable(m_server->whyNot()));
    auto window = newWindow();
    AnalysisSettings settings;
    settings.spectrogram.windowSeconds = 0.25;
    settings.noise.blockWindows = 8.0;
    setSetting(settings, "detector.kind", "energy"); // with nothing to be calibrated
    setSetting(settings, "decide.thresholdNats", "1000");
    window->listening().start([](const std::stop_token &) { return std::make_unique<Whistle>(); }, m_folder.path(),
                              settings);
    QTRY_VERIFY_WITH_TIMEOUT(window->document().isLive(), patience);
    Ear ear;
    ear.hear(1);
    auto *button = window->listening().bar().findChild<QToolButton *>("hear");
    button->click();
    Playback &hearing = *window->findChild<Playback *>();
    QVERIFY(hearing.isPlaying());
    ear.hear(4 * 48'000);
    QVERIFY2(ear.amplitude(2000.0) > 0.08, qPrintable(QString::number(ear.amplitude(2000.0))));
    window->document().viewport().setCursor({10.0, 2000.0});
    hearing.setWhat(Playback::What::Line);
    ear.hear(5 * 48'000);
    QVERIFY2(ear.amplitude(700.0) > 0.08, qPrintable(QString::number(ear.amplitude(700.0))));
    QVERIFY(ear.amplitude(2000.0) < 0.01);
    static const QRegularExpression later(QStringLiteral("heard ([0-9.]+) s later"));
    QTRY_VERIFY(later.match(plainText(childOf<QLabel>(window->listening().bar(), "Live"))).hasMatch());
    const double delay =
        later.match(plainText(childOf<QLabel>(window->listening().bar(), "Live"))).captured(1).toDouble();
    QVERIFY2(delay > 0.0 && delay < 5.0 * slowdown,
             qPrintable(plainText(childOf<QLabel>(window->listening().bar(), "Live"))));
    button->click();
    QVERIFY(!hearing.isPlaying());
    button->click();
    QVERIFY(hearing.isPlaying());
    window->listening().run().stop();
    QTRY_VERIFY_WITH_TIMEOUT(!hearing.isPlaying() && !button->isChecked(), patience);
    QTRY_VERIFY_WITH_TIMEOUT(!window->listening().run().isRunning(), patience);
    window.reset();
    m_window->activateWindow(); // whose keys the others press
    QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
}

void tst_Playback::startsAgainWhereTheCursorIsPut()
{
    if (!hasServer())
        QSKIP(qPrintable(m_server->whyNot()));
    viewport().setCursor({20.0, 2000.0});
    pressSpace();
    QTRY_VERIFY(cursor() > 20.1);
    viewport().setCursor({40.0, 1500.0});
    QTRY_VERIFY(cursor() > 40.1);
    QCOMPARE(viewport().cursor()->hz, 1500.0);
    QVERIFY(cursor() < 45.0);
    viewport().setCursor({59.0, 1500.0}); // to the end
    QTRY_VERIFY(!playback().isPlaying());
    viewport().setSelection({{30.0, 30.5}, {1000.0, 3000.0}});
    choose("Loop");
    pressSpace();
    QTRY_VERIFY(cursor() > 30.2 && cursor() <= 30.5);
    QTRY_VERIFY(cursor() < 30.2);
    QVERIFY(playback().isPlaying());
    m_server->stop();
    QTRY_VERIFY(!playback().isPlaying());
    QVERIFY(m_window->findChild<MessageBar *>()->text().contains("Connection terminated"));
}

FAINTLINE_WINDOW_TEST(tst_Playback)
#include "tst_Playback.moc"
