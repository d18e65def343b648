// Listening in the window: a pipe is fed, and what is to be seen then.

#include "app/Feeder.h"
#include "app/base/MessageBar.h"
#include "app/features/live/ListenDialog.h"
#include "app/features/live/LiveBar.h"
#include "app/features/pictures/Workbench.h"
#include "exchange/writeEvents.h"
#include "plan/slopeUnit.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/base/diskRoom.h"
#include "widgets/events/EventTable.h"
#include "widgets/plot/ExceedancePlot.h"

#include <QComboBox>
#include <QDoubleSpinBox>
#include <QLineEdit>

#include <cmath>
#include <csignal>
#include <thread>

using namespace faintline;
using namespace faintline::test;

class tst_Live : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { std::signal(SIGPIPE, SIG_IGN); }

    // The events of the table, and those of the recording that is open in the end, are those of `listen`.
    void showsAndRecords()
    {
        const QTemporaryDir folder;
        const std::vector<float> samples = scene(150.0);
        Feeder feeder(folder, samples);
        const auto window = listeningWindow(folder, feeder, m_settings);
        Document &document = window->document();
        QVERIFY(window->listening().bar().isVisible());
        feeder.allow(140.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.isLive() && document.live().time.last() > 138.0, patience);
        const Workbench &bench = window->workbench();
        QCOMPARE(bench.input()->picture()->frameCount(), document.live().time.count);
        QCOMPARE(bench.output()->picture()->frameCount(), document.live().time.count);
        const Axis &frequency = bench.input()->frequencyAxis();
        QVERIFY(frequency == document.live().plan->grid().axes.back());
        QVERIFY(*bench.input()->valueAt(60.0, 390.0) > *bench.input()->valueAt(60.0, 340.0)); // a line, and none
        QVERIFY(document.viewport().isFollowing());
        QVERIFY(std::abs(document.viewport().time().high - document.live().time.last()) < 1.0);
        QVERIFY(document.shownEvents().size() >= 4);
        QVERIFY(plainText(childOf<QLabel>(window->listening().bar(), "Live")).contains(QStringLiteral("UTC"))
                || plainText(childOf<QLabel>(window->listening().bar(), "Live")).contains('Z'));
        QVERIFY(
            plainText(childOf<QLabel>(window->listening().bar(), "Live")).contains(QStringLiteral("no sample lost")));

        QSignalSpy ended(&window->listening().run(), &LiveRun::ended);
        feeder.allowAll();
        QVERIFY(ended.wait(patience));
        const QString recording = window->listening().run().state().recording;
        QTRY_VERIFY_WITH_TIMEOUT(document.isCurrent() && !window->controller().isBusy(), patience);
        QVERIFY(!document.isLive());
        QVERIFY(window->listening().bar().isHidden());
        QCOMPARE(document.sourcePath(), recording);
        QVERIFY(document.settings().noise.causal);

        ListenSettings same;
        same.analysis = m_settings;
        class Given final : public SampleSource
        {
        public:
            explicit Given(const std::vector<float> &all) : m_all(all) {}
            const StreamFormat &format() const override { return m_format; }
            bool isPatient() const override { return true; }
            Heard hear(std::chrono::milliseconds) override
            {
                Heard heard;
                const auto bytes = std::as_bytes(std::span(m_all));
                if (!m_isDone)
                    heard.bytes.assign(bytes.begin(), bytes.end());
                heard.isOver = std::exchange(m_isDone, true);
                return heard;
            }

        private:
            const std::vector<float> &m_all;
            StreamFormat m_format = test::format();
            bool m_isDone = false;
        } given(samples);
        const ListenResult heard = listen(given, same, {});
        QVERIFY(heard.events.size() >= 4);
        QCOMPARE(QByteArray::fromStdString(eventsCsv(*document.analysis(), document.shownEvents())),
                 QByteArray::fromStdString(eventsCsv(heard.plan, heard.events)));
    }

    // Held, the picture stays while frames come in; what was heard can be scrolled back to; End goes to the newest.
    void holdsAndScrollsBack()
    {
        const QTemporaryDir folder;
        Feeder feeder(folder, scene(300.0));
        const auto window = listeningWindow(folder, feeder, m_settings);
        Document &document = window->document();
        Viewport &viewport = document.viewport();
        feeder.allow(150.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.isLive() && document.live().time.last() > 148.0, patience);
        QVERIFY(viewport.isFollowing());
        const double width = viewport.time().width();
        viewport.pan(-30.0, 0.0);
        QVERIFY(!viewport.isFollowing());
        const Span held = viewport.time();
        feeder.allow(200.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.live().time.last() > 198.0, patience);
        QVERIFY(viewport.time() == held);
        QVERIFY(viewport.full().time.high > 198.0);
        viewport.pan(-1e6, 0.0); // to the beginning
        QVERIFY(viewport.time().low <= document.live().time.first);
        QTest::keyClick(&window->workbench(), Qt::Key_End);
        QVERIFY(viewport.isFollowing());
        QVERIFY(std::abs(viewport.time().high - viewport.full().time.high) < 1e-9);
        QVERIFY(std::abs(viewport.time().width() - width) < 1e-6);
        window->workbench().setPlaying(false); // Space
        const Span stopped = viewport.time();
        feeder.allow(250.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.live().time.last() > 248.0, patience);
        QVERIFY(viewport.time() == stopped);
        window->workbench().setPlaying(true);
        feeder.allow(280.0);
        QTRY_VERIFY_WITH_TIMEOUT(viewport.time().high > 278.0, patience);
        window->listening().run().stop();
        QTRY_VERIFY_WITH_TIMEOUT(!window->listening().run().isRunning(), patience);
    }

    void recordsInSeveralFiles()
    {
        const QTemporaryDir folder;
        Feeder feeder(folder, scene(120.0));
        const auto window = newWindow();
        RotationSettings rotation;
        rotation.longestSeconds = 30.0;
        window->listening().start(feeder.source(), folder.path(), m_settings, rotation);
        Document &document = window->document();
        feeder.allow(100.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.isLive() && document.live().time.last() > 98.0, patience);
        feeder.allowAll();
        QTRY_VERIFY_WITH_TIMEOUT(!document.isLive() && document.isCurrent() && settle(*window), patience);
        QCOMPARE(QDir(folder.path()).entryList({QStringLiteral("*.sigmf-meta")}).size(), 4);
        QVERIFY(document.sourcePath().endsWith(QStringLiteral(".timeline")));
        QCOMPARE(document.recording()->info().sampleCount, Index(120'000));
        QVERIFY(document.shownEvents().size() >= 4);
    }

    void asksWhenAnotherFileBegins()
    {
        const QTemporaryDir folder;
        ListenDialog dialog;
        dialog.show();
        QCOMPARE(dialog.rotation().longestSeconds, 0.0);
        QCOMPARE(dialog.rotation().largestBytes, 0.0);
        dialog.findChild<QDoubleSpinBox *>("longest")->setValue(30.0);
        dialog.findChild<QDoubleSpinBox *>("largest")->setValue(500.0);
        QCOMPARE(dialog.rotation().longestSeconds, 1800.0);
        QCOMPARE(dialog.rotation().largestBytes, 500e6);
        dialog.findChild<QLineEdit *>("folder")->setText(folder.filePath("to/be/made"));
        auto *kind = dialog.findChild<QComboBox *>("sourceKind");
        kind->setCurrentIndex(kind->findText("Pipe or file")); // whose header would tell its rate
        const double room = *freeBytes(folder.path()) / 1e9;
        static const QRegularExpression free(QStringLiteral("([0-9.]+) GB free$"));
        QTRY_VERIFY(free.match(dialog.findChild<QLabel *>("disk")->text()).hasMatch());
        QVERIFY(std::abs(free.match(dialog.findChild<QLabel *>("disk")->text()).captured(1).toDouble() - room)
                < 0.1 * room);
        kind->setCurrentIndex(kind->findText("UDP")); // 48 kHz of 16 bits
        QTRY_VERIFY(dialog.findChild<QLabel *>("disk")->text().contains(QStringLiteral("GB free, full in ")));
    }

    void changesTheThreshold()
    {
        const QTemporaryDir folder;
        Feeder feeder(folder, scene(300.0));
        const auto window = listeningWindow(folder, feeder, m_settings);
        Document &document = window->document();
        feeder.allow(60.0);
        QTRY_VERIFY_WITH_TIMEOUT(document.isLive() && document.live().time.last() > 58.0, patience);
        const double before = document.live().plan->threshold;
        window->controller().stepThreshold(8);
        feeder.allow(62.0);
        QTRY_VERIFY_WITH_TIMEOUT(
            (feeder.allow(std::min(document.live().time.last() + 4.0, 250.0)), !document.live().changes.empty()),
            patience);
        const SettingsChange &change = document.live().changes.front();
        QVERIFY(change.seconds > 58.0);
        QVERIFY(document.live().plan->threshold > before + 1.0);
        QCOMPARE(document.shownThreshold(), document.live().plan->threshold);
        QCOMPARE(*window->workbench().output()->threshold(), document.live().plan->threshold);
        // A plan that comes late is of older settings, and changes nothing of the newer ones.
        window->controller().setThresholdUnit(DecideSettings::By::PfaPerCell);
        LiveView late = document.live();
        late.plan = std::make_shared<const AnalysisPlan>(*late.plan);
        QVERIFY(late.plan->settings.decide.by != DecideSettings::By::PfaPerCell);
        document.setLive(late);
        QCOMPARE(document.settings().decide.by, DecideSettings::By::PfaPerCell);
        QCOMPARE(window->thresholdPlot().unit(), ExceedancePlot::Unit::PfaPerCell);
        window->listening().run().stop();
        QTRY_VERIFY_WITH_TIMEOUT(!window->listening().run().isRunning(), patience);
    }

    void stopsWhenTheWindowCloses()
    {
        const QTemporaryDir folder;
        Feeder feeder(folder, scene(120.0));
        const auto window = listeningWindow(folder, feeder, m_settings);
        feeder.allow(60.0);
        QTRY_VERIFY_WITH_TIMEOUT(window->document().isLive() && window->document().live().time.last() > 50.0, patience);
        window->close();
        QTRY_VERIFY_WITH_TIMEOUT(window->isHidden(), patience);
        QVERIFY(!window->listening().run().isRunning());
        const auto kept = openRecording(window->listening().run().state().recording.toStdString());
        QVERIFY(kept->info().durationSeconds() > 50.0);
    }

    void tellsOfASourceThatCannotBe()
    {
        const QTemporaryDir folder;
        const auto window = newWindow();
        window->listening().start(
            [](const std::stop_token &stop) -> std::unique_ptr<SampleSource> {
                return std::make_unique<PipeSource>("/nowhere/fifo", format(), stop);
            },
            folder.path());
        QTRY_VERIFY_WITH_TIMEOUT(!window->listening().run().isRunning(), patience);
        QVERIFY(window->messages().text().contains(QStringLiteral("/nowhere/fifo")));
        QVERIFY(window->listening().bar().isHidden());
        QVERIFY(QDir(folder.path()).entryList({QStringLiteral("*.sigmf-*")}).isEmpty());
    }

    // A receiver that goes away and comes back: a sentence, a gap of known length, and the run goes on.
    void tellsWhatIsLost()
    {
        class Receiver final : public SampleSource
        {
        public:
            explicit Receiver(std::vector<float> all) : m_all(std::move(all)) {}
            const StreamFormat &format() const override { return m_format; }
            bool isPatient() const override { return true; }
            Heard hear(std::chrono::milliseconds patience) override
            {
                Heard heard;
                if (m_at >= m_all.size()) {
                    std::this_thread::sleep_for(patience);
                    return heard;
                }
                if (m_at == 30'000 && !std::exchange(m_isGone, true)) {
                    heard.incident = Heard::Incident::Gone;
                    heard.words = "The receiver has gone.";
                    return heard;
                }
                if (m_at == 30'000) {
                    heard.incident = Heard::Incident::Back;
                    heard.lostSamples = 1500;
                    heard.words = "The receiver is back.";
                }
                const auto bytes = std::as_bytes(std::span(m_all).subspan(m_at, 1000));
                heard.bytes.assign(bytes.begin(), bytes.end());
                m_at += 1000;
                return heard;
            }

        private:
            std::vector<float> m_all;
            StreamFormat m_format = test::format();
            std::size_t m_at = 0;
            bool m_isGone = false;
        };
        const QTemporaryDir folder;
        const auto window = newWindow();
        QSignalSpy notices(&window->listening().run(), &LiveRun::noticed);
        window->listening().start([](const std::stop_token &) { return std::make_unique<Receiver>(scene(120.0)); },
                                  folder.path(), m_settings);
        QTRY_VERIFY_WITH_TIMEOUT(window->document().isLive() && window->document().live().time.last() > 119.0,
                                 patience);
        QTRY_COMPARE_WITH_TIMEOUT(notices.count(), 2, patience);
        QVERIFY2(window->messages().text().contains(QStringLiteral("The receiver is back.")),
                 qPrintable(window->messages().text()));
        QTRY_VERIFY2(plainText(childOf<QLabel>(window->listening().bar(), "Live"))
                         .contains(QStringLiteral("1.500 s of samples lost in 1 gap")),
                     qPrintable(plainText(childOf<QLabel>(window->listening().bar(), "Live"))));
        QCOMPARE(window->document().live().lostCount, Index(1500));
        window->listening().run().stop();
        QTRY_VERIFY_WITH_TIMEOUT(!window->listening().run().isRunning(), patience);
        const auto kept = openRecording(window->listening().run().state().recording.toStdString());
        QCOMPARE(kept->info().sampleCount, Index(121'500));
    }

private:
    const AnalysisSettings m_settings = liveSettings();
};

FAINTLINE_WINDOW_TEST(tst_Live)
#include "tst_Live.moc"
