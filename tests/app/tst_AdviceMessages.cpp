#include "app/base/MessageBar.h"
#include "app/openWindow.h"
#include "scene/SimulatedRecording.h"
#include "signal/formats/writeRecording.h"
#include "support/test.h"

#include <QToolButton>

using namespace faintline;
using namespace faintline::test;

/// What is said of a strange recording above its pictures, and the button that helps.
class tst_AdviceMessages : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        LineScene scene;
        scene.sampleRateHz = 400.0;
        scene.durationSeconds = 60.0;
        scene.noise.deviation = 0.05;
        LineSettings line;
        line.snrDb = 14.0;
        line.frequencyHz = 20.0;
        line.driftHzPerSecond = 22.0;
        line.durationSeconds = 7.0;
        scene.lines.push_back(line);
        m_recording = m_folder.filePath("fast.wav");
        writeRecording(SimulatedRecording(scene), m_recording.toStdString());
    }

    void oneClickMendsIt()
    {
        const auto window = newWindow();
        QVERIFY(openFast(*window));
        QVERIFY2(window->messages().text().contains("as fast as the model allows, 16 Hz/s"),
                 qPrintable(window->messages().text()));
        auto *button = window->messages().findChildren<QToolButton *>().front();
        for (QToolButton *each : window->messages().findChildren<QToolButton *>())
            button = each->text().contains("0.13 s") ? each : button;
        QCOMPARE(button->text(), QString("Use a window of 0.13 s"));
        button->click();
        QVERIFY(settle(*window));
        QVERIFY(settle(window->recordingCheck()));
        QCOMPARE(window->document().settings().spectrogram.windowSeconds, 0.13);
        QCOMPARE(window->messages().text(), QString());
        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier); // one step back
        QVERIFY(settle(*window));
        QCOMPARE(window->document().settings().spectrogram.windowSeconds, 0.25);
    }

    void saidOnce()
    {
        const auto window = newWindow();
        QVERIFY(openFast(*window));
        window->messages().dismiss();
        window->controller().run();
        QVERIFY(settle(*window));
        QVERIFY(settle(window->recordingCheck()));
        QCOMPARE(window->messages().text(), QString());
        QVERIFY(openFast(*window)); // anew
        QVERIFY(!window->messages().text().isEmpty());
    }

private:
    bool openFast(MainWindow &window)
    {
        return openAndSettle(window, m_recording,
                             [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.25; })
               && settle(window.recordingCheck());
    }

    QTemporaryDir m_folder;
    QString m_recording;
};

FAINTLINE_WINDOW_TEST(tst_AdviceMessages)
#include "tst_AdviceMessages.moc"
