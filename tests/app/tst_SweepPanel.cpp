#include "app/base/StartColumn.h"
#include "app/features/evaluate/SweepForm.h"
#include "app/features/evaluate/SweepPanel.h"
#include "app/openWindow.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/plot/ChartPlot.h"

#include <qwt_plot.h>

#include <QPushButton>

using namespace faintline;
using namespace faintline::test;

/// A sweep in the window: it grows, can be cancelled, and a click takes a value.
class tst_SweepPanel : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;

    void openLine(MainWindow &window)
    {
        const QString scene =
            writeFile(m_folder, "scene.json",
                      R"({"kind": "lines", "sampleRateHz": 400, "durationSeconds": 60, "lines": [{"snrDb": 5,
               "frequencyHz": 90}]})");
        QVERIFY(openAndSettle(window, scene, [](AnalysisSettings &settings) {
            settings.spectrogram.windowSeconds = 0.5;
            settings.model.lowestSlope = settings.model.highestSlope = 0;
            settings.model.slopeChange = {1.0};
        }));
    }

private slots:
    void aClickTakesTheValue()
    {
        const auto own = newWindow();
        MainWindow &window = *own;
        openLine(window);
        window.showView("sweep");
        SweepPanel &panel = window.panel<SweepPanel>();
        panel.form().setParameter("decide.thresholdNats");
        panel.form().setRange(5.0, 15.0, 3, false);
        panel.form().setLines(3.0, 10.0, 4);
        QSignalSpy busy(&window.experiments(), &Experiments::busyChanged);
        panel.start();
        QVERIFY(window.experiments().isBusy());
        QTRY_VERIFY_WITH_TIMEOUT(!window.experiments().isBusy(), patience);
        const Experiments::Entry *entry = window.experiments().entry(panel.shown());
        QCOMPARE(entry->state, Experiments::State::Done);
        QCOMPARE(entry->runsDone(), 12);
        QCOMPARE(childOf<QLabel>(panel, "What is shown").text(), QString()); // it is the form's own
        panel.form().setRange(6.0, 15.0, 3, false);
        QVERIFY2(childOf<QLabel>(panel, "What is shown")
                     .text()
                     .contains("decide.thresholdNats = 5 … 15, 4 trials, 3 dB, 10 s, seed 1"),
                 qPrintable(childOf<QLabel>(panel, "What is shown").text()));
        panel.show(panel.shown()); // as from the list of experiments: the form shows its values
        QCOMPARE(childOf<QLabel>(panel, "What is shown").text(), QString());
        QCOMPARE(panel.tradeOff().chart().curves.front().points.size(), std::size_t(3));
        QTRY_COMPARE(panel.cost().chart().curves.size(), std::size_t(1));

        const double before = window.document().settings().decide.thresholdNats;
        QPointF at = panel.tradeOff().canvasPosition(0, 1);
        QTest::mouseClick(panel.tradeOff().plot()->canvas(), Qt::LeftButton, {}, at.toPoint());
        QCOMPARE(window.document().settings().decide.thresholdNats, 10.0);
        QCOMPARE(window.document().settings().decide.by, DecideSettings::By::Nats);
        window.document().undoStack().undo();
        QCOMPARE(window.document().settings().decide.thresholdNats, before);
        QTRY_VERIFY_WITH_TIMEOUT(!window.controller().isBusy(), patience);
    }

    void cancelledItKeepsWhatThereIs()
    {
        MainWindow window;
        window.setAsking(false);
        window.show();
        openLine(window);
        SweepPanel &panel = window.panel<SweepPanel>();
        panel.form().setRange(5.0, 15.0, 3, false);
        panel.form().setLines(3.0, 10.0, 5000);
        panel.start();
        QTRY_VERIFY_WITH_TIMEOUT(window.experiments().entry(panel.shown())->runsDone() > 3, patience);
        panel.cancel();
        QTRY_VERIFY_WITH_TIMEOUT(!window.experiments().isBusy(), patience);
        const Experiments::Entry *entry = window.experiments().entry(panel.shown());
        QCOMPARE(entry->state, Experiments::State::Cancelled);
        QVERIFY(entry->runsDone() < 15000);
        QVERIFY(!panel.pd().chart().curves.empty());
    }

    void whatCannotBeIsSaid()
    {
        MainWindow window;
        window.setAsking(false);
        SweepPanel &panel = window.panel<SweepPanel>();
        QSignalSpy failed(&panel, &SweepPanel::failed);
        panel.form().setParameter("model.snr");
        panel.form().setRange(-3.0, 1.0, 3, false);
        panel.start();
        QCOMPARE(failed.size(), 1);
        QVERIFY(!window.experiments().isBusy());
    }
};

FAINTLINE_WINDOW_TEST(tst_SweepPanel)
#include "tst_SweepPanel.moc"
