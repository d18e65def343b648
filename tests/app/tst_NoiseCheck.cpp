#include "app/features/inspect/InfoPanel.h"
#include "app/features/inspect/NoiseCheck.h"
#include "app/openWindow.h"
#include "support/find.h"
#include "support/test.h"
#include "widgets/plot/ExceedancePlot.h"

#include <QLabel>
#include <QPushButton>

using namespace faintline;
using namespace faintline::test;

/// "Count on noise like this recording's": a job that can be stopped, a sentence, and a threshold moved by a click.
class tst_NoiseCheck : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase()
    {
        m_scene = writeFile(m_folder, "noise.json",
                            R"({"sampleRateHz": 200, "durationSeconds": 120, "noise": {"deviation": 1}})");
    }

    void saysWhatCame()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, m_scene));
        NoiseCheck &check = childOf<NoiseCheck>(window->panel<InfoPanel>());
        QVERIFY(settle(window->recordingCheck()));
        QVERIFY(label(check, "noiseWarning")->isHidden()); // white noise follows its law
        button(check, "countOnSurrogates")->click();
        QVERIFY(isBusy(window->recordingCheck()));
        QCOMPARE(button(check, "countOnSurrogates")->text(), QString("Stop"));
        QVERIFY(settle(window->recordingCheck()));
        const QString said = label(check, "surrogateResult")->text();
        QVERIFY2(said.contains(" specified in ") && said.contains("ratio "), qPrintable(said));
        QVERIFY(!label(check, "surrogateResult")->isHidden());
        QCOMPARE(button(check, "countOnSurrogates")->text(), QString("Count on noise like this recording's"));
    }

    void canBeStopped()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, m_scene));
        NoiseCheck &check = childOf<NoiseCheck>(window->panel<InfoPanel>());
        QVERIFY(settle(window->recordingCheck()));
        check.toggle();
        QVERIFY(isBusy(window->recordingCheck()));
        check.toggle();
        QVERIFY(settle(window->recordingCheck()));
        QVERIFY(label(check, "surrogateResult")->isHidden());
    }

    void correctsByAClick()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, m_scene));
        NoiseCheck &check = childOf<NoiseCheck>(window->panel<InfoPanel>());
        QVERIFY(settle(window->recordingCheck()));
        const double before = window->document().analysis()->threshold;
        SurrogateCount count;
        count.hours = 2.0;
        count.ordered = 30.0;
        count.events = 90;
        count.ratio = 3.0;
        count.interval = {2.4, 3.7};
        check.show(count);
        QVERIFY(button(check, "correctThreshold")->isHidden()); // nothing to correct
        count.correction = 0.75;
        check.show(count);
        QVERIFY(!button(check, "correctThreshold")->isHidden());
        button(check, "correctThreshold")->click();
        QVERIFY(settle(*window));
        QCOMPARE(window->document().settings().decide.by, DecideSettings::By::Nats);
        QVERIFY(std::abs(window->document().analysis()->threshold - (before + 0.75)) < 0.0051);
        QVERIFY(button(check, "correctThreshold")->isHidden()); // of other settings it was said
        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QCOMPARE(window->document().analysis()->threshold, before);
    }

    /// The same under the threshold's plot.
    void theThresholdSaysSo()
    {
        const auto window = newWindow();
        QVERIFY(openAndSettle(*window, m_scene));
        QVERIFY(settle(window->recordingCheck()));
        auto *sentence = window->findChild<QLabel *>("ownNoise");
        auto *cure = window->findChild<QPushButton *>("cureOwnNoise");
        QVERIFY(!cure->isVisible()); // white noise is what it was calibrated for
        QCOMPARE(window->thresholdPlot().labelText().count('\n'), 1);
        const double before = window->document().analysis()->threshold;
        SurrogateCount count;
        count.ratio = 40.0;
        count.correction = 2.5;
        window->recordingCheck().setCount(count);
        QVERIFY(cure->isVisible());
        QCOMPARE(sentence->text(), QString("This noise gives 40 times the specified false alarms."));
        QVERIFY(window->thresholdPlot().labelText().contains("this noise: about 40/h"));
        cure->click();
        QVERIFY(settle(*window));
        QVERIFY(std::abs(window->document().analysis()->threshold - (before + 2.5)) < 0.0051);
        QVERIFY(settle(window->recordingCheck()));
        QVERIFY(!cure->isVisible()); // of other settings it was said
        QCOMPARE(window->thresholdPlot().labelText().count('\n'), 0);
        QVERIFY(sentence->isVisible());
        QCOMPARE(sentence->text(), QString("The threshold is corrected for this noise."));
        QTest::keyClick(window.get(), Qt::Key_Z, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QVERIFY(settle(window->recordingCheck()));
        QVERIFY(!sentence->isVisible());
    }

private:
    static QLabel *label(NoiseCheck &check, const char *name) { return check.findChild<QLabel *>(name); }
    static QPushButton *button(NoiseCheck &check, const char *name) { return check.findChild<QPushButton *>(name); }

    QTemporaryDir m_folder;
    QString m_scene;
};

FAINTLINE_WINDOW_TEST(tst_NoiseCheck)
#include "tst_NoiseCheck.moc"
