#include "app/openWindow.h"
#include "app/panels/EvaluatePanel.h"
#include "app/views/ChartMenus.h"
#include "app/views/chartCaption.h"
#include "app/workspace/Workbench.h"
#include "support/test.h"
#include "widgets/plot/ChartPlot.h"
#include "widgets/plot/ExceedancePlot.h"
#include "widgets/plot/StripPlot.h"

#include <QContextMenuEvent>
#include <QMenu>
#include <QTimer>

using namespace faintline;
using namespace faintline::test;

/// Charts leave the window by their own menus, with a caption of what they were made from.
class tst_ChartMenus : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        m_window = newWindow();
        QVERIFY(openAndSettle(*m_window,
                              writeFile(m_folder, "noise.json",
                                        R"({"sampleRateHz": 200, "durationSeconds": 60, "noise": {"deviation": 1}})"),
                              [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }));
    }
    void cleanupTestCase() { m_window.reset(); }

    void everyChartHasTheMenu_data()
    {
        QTest::addColumn<QWidget *>("chart");
        QTest::newRow("pd") << static_cast<QWidget *>(&m_window->evaluation().pd());
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
        QVERIFY(svg.contains("<svg") && svg.contains("noise.json") && svg.contains("Window length 0.5 s"));
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
        QCOMPARE(said(CaptionOf::Statistic), QString("noise.json; Spectrogram: Window length 0.5 s"));
        AnalysisSettings settings = m_window->document().settings();
        setSetting(settings, "decide.thresholdNats", "20");
        setSetting(settings, "selection.toSeconds", "30");
        m_window->controller().setSettings(settings, "test");
        QVERIFY(settle(*m_window));
        QCOMPARE(said(CaptionOf::Statistic),
                 QString("noise.json; Selection: To 30 s; Spectrogram: Window length 0.5 s; Threshold 20 nat"));
        QCOMPARE(said(CaptionOf::Input), QString("noise.json; Selection: To 30 s; Spectrogram: Window length 0.5 s"));
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

    QTemporaryDir m_folder;
    std::unique_ptr<MainWindow> m_window;
};

FAINTLINE_WINDOW_TEST(tst_ChartMenus)
#include "tst_ChartMenus.moc"
