#include "app/features/evaluate/EvaluatePanel.h"
#include "app/features/pictures/Workbench.h"
#include "app/openWindow.h"
#include "app/views/ChartMenus.h"
#include "app/views/chartCaption.h"
#include "support/test.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"

#include <QContextMenuEvent>
#include <QMenu>

using namespace faintline;
using namespace faintline::test;

/// Charts leave the window by their own menus, with a caption of what they were made from.
class tst_ChartMenus : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        QVERIFY(open(R"({"sampleRateHz": 200, "durationSeconds": 60, "noise": {"deviation": 1}})",
                     [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }));
    }

    void everyChartHasTheMenu_data()
    {
        QTest::addColumn<QWidget *>("chart");
        QTest::newRow("pd") << static_cast<QWidget *>(&m_window->panel<EvaluatePanel>().pd());
        QTest::newRow("threshold") << static_cast<QWidget *>(&m_window->thresholdPlot());
        QTest::newRow("statistic") << static_cast<QWidget *>(m_window->workbench().statisticPlot());
    }

    void everyChartHasTheMenu()
    {
        QFETCH(QWidget *, chart);
        QStringList texts;
        QTimer::singleShot(0, this, [&texts] {
            auto *menu = qobject_cast<QMenu *>(QApplication::activePopupWidget());
            for (const QAction *action : menu ? menu->actions() : QList<QAction *>())
                texts << action->text();
            if (menu)
                menu->close();
        });
        QContextMenuEvent event(QContextMenuEvent::Mouse, {20, 20}, chart->mapToGlobal(QPoint(20, 20)));
        QCoreApplication::sendEvent(chart, &event);
        QVERIFY2(texts.contains("Save chart…"), qPrintable(texts.join('|')));
    }

    void everyFormat()
    {
        QWidget &chart = m_window->thresholdPlot();
        const QByteArray svg = saved(chart, "chart.svg");
        QVERIFY(svg.contains("<svg") && svg.contains("scene.json") && svg.contains("Window length 0.5 s"));
        QVERIFY(saved(chart, "chart.pdf").startsWith("%PDF"));
        QVERIFY(saved(chart, "chart.png").startsWith("\x89PNG"));
        QVERIFY(saved(chart, "chart.csv").startsWith("curve,x,y\n\"noise, fitted law\","));
        QVERIFY(QFile::exists(m_folder.filePath("chart.csv.provenance.json")));
        QVERIFY(saved(*m_window->workbench().statisticPlot(), "strip.csv").count('\n') > 100);
    }

    void captionsNameWhatDiffersFromTheDefaults()
    {
        const auto said = [this](CaptionOf what) {
            return captionOf(m_window->document(), what).section(". Faintline", 0, 0);
        };
        QCOMPARE(said(CaptionOf::Statistic), QString("scene.json; Spectrogram: Window length 0.5 s"));
        AnalysisSettings settings = m_window->document().settings();
        setSetting(settings, "decide.thresholdNats", "20");
        setSetting(settings, "selection.toSeconds", "30");
        m_window->controller().setSettings(settings, "test");
        QVERIFY(settle(*m_window));
        QCOMPARE(said(CaptionOf::Statistic),
                 QString("scene.json; Selection: To 30 s; Spectrogram: Window length 0.5 s; Threshold 20 nat"));
        QCOMPARE(said(CaptionOf::Input), QString("scene.json; Selection: To 30 s; Spectrogram: Window length 0.5 s"));
    }

    void captionsSayThingsOnce()
    {
        const auto lines =
            experimentFromJson(Json::parse(R"({"kind": "lines", "runs": 2, "snrDb": [-2, 2], "detectors": [
            {"name": "free", "settings": {"model.slopeChange": [0.3333333333333333, 0.3333333333333333],
                                          "model.snr": 1}},
            {"name": "bound", "settings": {"model.slopeChange": [0.5, 0.25], "model.snr": 1}}]})"),
                               "experiment");
        Experiments::Entry entry;
        entry.name = "Lines";
        entry.campaign = Campaign{lines, {}, {}};
        const QString words = captionOf(entry);
        QVERIFY2(words.startsWith("Lines; 0 runs done; 2 runs, -2 … 2 dB, "), qPrintable(words));
        QVERIFY2(
            words.contains("; Signal model: Design SNR 1; free (Signal model: Slope change law 0.333333, 0.333333); "
                           "bound (Signal model: Slope change law 0.5, 0.25). Faintline"),
            qPrintable(words));
        entry.campaign->outcomes.resize(2);
        QVERIFY2(captionOf(entry).startsWith("Lines; 2 runs, "), qPrintable(captionOf(entry)));

        AnalysisSettings settings = m_window->document().settings();
        setSetting(settings, "spectrogram.stepsPerWindow", "4");
        m_window->controller().setSettings(settings, "test");
        QVERIFY(settle(*m_window));
        QVERIFY(captionOf(m_window->document(), CaptionOf::Input)
                    .contains("Spectrogram: Window length 0.5 s, Frames per window 4"));
    }

private:
    QByteArray saved(QWidget &chart, const char *name)
    {
        const QString path = m_folder.filePath(name);
        QSignalSpy written(&m_window->chartMenus(), &ChartMenus::written);
        m_window->chartMenus().saveTo(chart, path);
        if (written.isEmpty() && !written.wait(patience))
            return {};
        QFile file(path);
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }
};

FAINTLINE_WINDOW_TEST(tst_ChartMenus)
#include "tst_ChartMenus.moc"
