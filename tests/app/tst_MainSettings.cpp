// The five settings that are changed first, below the threshold of a narrow window.

#include "app/features/settings/MainSettings.h"
#include "app/features/settings/PipelinePanel.h"
#include "app/features/settings/ThresholdPanel.h"
#include "app/openWindow.h"
#include "app/window/Panels.h"
#include "support/test.h"
#include "widgets/forms/SettingRow.h"
#include "widgets/forms/SettingsForm.h"
#include "widgets/plot/ExceedancePlot.h"

#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>

using namespace faintline;
using namespace faintline::test;

class tst_MainSettings : public WindowTest
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        constexpr QSize room(1280, 776); // a screen of 1280 × 800 with a window's title bar
        QVERIFY(open(R"({"kind": "lines", "sampleRateHz": 1000, "durationSeconds": 20, "lines": []})",
                     [](AnalysisSettings &settings) { settings.spectrogram.windowSeconds = 0.5; }, room));
        m_main = m_window->findChild<ThresholdPanel *>()->findChild<MainSettings *>();
        QVERIFY(m_main);
        QVERIFY(QTest::qWaitFor([&] { return m_main->isVisible(); }));
    }

    void theFiveAreThereAndThePlotHasRoom()
    {
        QStringList names;
        for (SettingRow *one : m_main->findChildren<SettingRow *>()) {
            QVERIFY2(one->isVisible() && one->visibleRegion().boundingRect().size() == one->size(),
                     one->info().name.c_str());
            names << QString::fromStdString(one->info().name);
        }
        names.sort();
        QCOMPARE(names, QStringList({"decide.falseAlarmsPerHour", "model.highestSlope", "model.lowestSlope",
                                     "model.snr", "spectrogram.windowSeconds"}));
        const int height = m_window->thresholdPlot().canvas()->height();
        QVERIFY2(height >= 120, qPrintable(QString::number(height)));
    }

    void theyAreTheFormsSettings()
    {
        for (SettingRow *one : m_main->findChildren<SettingRow *>()) {
            const QWidget *there =
                m_window->panel<PipelinePanel>().form()->editor(QString::fromStdString(one->info().name));
            QVERIFY(there && !one->editor()->property("text").toString().isEmpty());
            QCOMPARE(one->editor()->property("text"), there->property("text"));
        }
    }

    void whatIsTypedIsAStepToUndo()
    {
        type("decide.falseAlarmsPerHour", "5");
        QCOMPARE(m_window->document().settings().decide.falseAlarmsPerHour, 5.0);
        QVERIFY(settle(*m_window));
        m_window->document().undoStack().undo();
        QCOMPARE(m_window->document().settings().decide.falseAlarmsPerHour, 1.0);
        QCOMPARE(line("decide.falseAlarmsPerHour")->text(), QString("1"));
        QVERIFY(settle(*m_window));
    }

    void aMistakeIsSaidBelowItsRow()
    {
        type("model.lowestSlope", "50"); // above the highest
        QVERIFY(settle(*m_window));
        const auto isSaid = [&] {
            for (const QLabel *label : row("model.lowestSlope")->findChildren<QLabel *>())
                if (label->isVisible() && label->text().contains("highestSlope"))
                    return true;
            for (const QLabel *label : row("model.highestSlope")->findChildren<QLabel *>())
                if (label->isVisible() && label->text().contains("lowestSlope"))
                    return true;
            return false;
        };
        QVERIFY(isSaid());
        m_window->document().undoStack().undo();
        QVERIFY(!isSaid());
        QVERIFY(settle(*m_window));
    }

    void slopesHaveTheUnitOfTheSettings()
    {
        const auto unit = [&](const char *text) {
            for (const QLabel *label : row("model.highestSlope")->findChildren<QLabel *>())
                if (label->text() == QLatin1String(text))
                    return true;
            return false;
        };
        QVERIFY(unit("bins/frame") && !unit("Hz/s"));
        m_window->controller().edit("model.slopeUnit", FieldValue(std::string("hzPerSecond")), "unit");
        QVERIFY(unit("Hz/s") && !unit("bins/frame"));
        m_window->document().undoStack().undo();
        QVERIFY(settle(*m_window));
    }

    void theyGoWhereTheFormIsSeen()
    {
        auto *form = m_window->findChild<QDockWidget *>("pipelineDock");
        auto *threshold = m_window->findChild<QDockWidget *>("thresholdDock");
        m_window->addDockWidget(Qt::LeftDockWidgetArea, form);
        form->show();
        QVERIFY(QTest::qWaitFor([&] { return !m_main->isVisible() && threshold->isVisible(); }));
        m_window->findChild<Panels *>()->takeLayout(Panels::researcher());
        QVERIFY(QTest::qWaitFor([&] { return m_main->isVisible(); }));
    }

    void pingsHaveNone()
    {
        QVERIFY(openAndSettle(*m_window,
                              writeFile(m_folder, "pings.json", R"({"kind": "pings", "pings": 8, "targets": []})")));
        QVERIFY(QTest::qWaitFor([&] { return !m_main->isVisible(); }));
        QVERIFY(!m_main->isApplicable());
    }

private:
    SettingRow *row(const char *name) const
    {
        for (SettingRow *one : m_main->findChildren<SettingRow *>())
            if (one->info().name == name)
                return one;
        return nullptr;
    }
    QLineEdit *line(const char *name) const { return qobject_cast<QLineEdit *>(row(name)->editor()); }
    void type(const char *name, const char *text) const
    {
        line(name)->selectAll();
        QTest::keyClicks(line(name), text);
        QTest::keyClick(line(name), Qt::Key_Return);
    }

    MainSettings *m_main = nullptr;
};

FAINTLINE_WINDOW_TEST(tst_MainSettings)
#include "tst_MainSettings.moc"
