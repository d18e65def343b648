#include "app/features/pictures/BoxAnalysis.h"
#include "app/openWindow.h"
#include "support/test.h"

using namespace faintline;
using namespace faintline::test;

/// *Analyse this box* and *Analyse what I see*: from a drag to an analysis of that part, and back.
class tst_BoxAnalysis : public QObject
{
    Q_OBJECT

private slots:
    void boxesAreRoundedOutwards()
    {
        const SelectionSettings part = inBox({}, {{12.3456, 45.6701}, {70.06, 80.01}}, 0.125, 2.0).selection;
        QCOMPARE(part.fromSeconds, 12.34);
        QCOMPARE(part.toSeconds, 45.68);
        QCOMPARE(part.lowHz, 70.0);
        QCOMPARE(part.highHz, 80.1);
        QCOMPARE(inBox({}, {{-0.02, 1.0}, {-5.0, 5.0}}, 0.125, 2.0).selection.fromSeconds, 0.0);
        // A box of fundamentals becomes the band that their members lie in.
        AnalysisSettings family;
        family.family = {FamilySettings::Relation::Harmonics, {2.0, 5.0}, FamilySettings::Present::Together};
        const SelectionSettings band = inBox(family, {{1.0, 2.0}, {10.0, 12.0}}, 0.125, 2.0).selection;
        QCOMPARE(band.lowHz, 20.0);
        QCOMPARE(band.highHz, 60.0);
    }

    void ofTheMeasuredBoxAndBack()
    {
        QTemporaryDir folder;
        const auto window = newWindow();
        QVERIFY(openAndSettle(
            *window, writeFile(folder, "noise.json",
                               R"({"sampleRateHz": 200, "durationSeconds": 120, "noise": {"deviation": 1}})")));
        Document &document = window->document();
        const Index frames = document.analysis()->time().count;
        const AnalysisSettings before = document.settings();
        QTest::keyClick(window.get(), Qt::Key_Return, Qt::ControlModifier); // no box, nothing happens
        QCOMPARE(document.settings(), before);
        document.viewport().setSelection({{40.0, 80.0}, {20.0, 60.0}});
        QTest::keyClick(window.get(), Qt::Key_Return, Qt::ControlModifier);
        QVERIFY(settle(*window));
        QCOMPARE(document.settings().selection.fromSeconds, 40.0);
        QCOMPARE(document.settings().selection.toSeconds, 80.0);
        QCOMPARE(document.settings().selection.lowHz, 20.0);
        QCOMPARE(document.settings().selection.highHz, 60.0);
        QVERIFY(document.analysis()->time().count < frames / 2);
        QVERIFY(document.viewport().full().time.low >= 39.9); // seconds of the recording, not of the part
        QVERIFY(!document.viewport().selection());
        QTest::keyClick(window.get(), Qt::Key_Return, Qt::ControlModifier | Qt::ShiftModifier);
        QVERIFY(settle(*window));
        QCOMPARE(document.analysis()->time().count, frames);
        QCOMPARE(document.settings(), before);
        ofWhatIsVisible(*window);
    }

private:
    static void ofWhatIsVisible(MainWindow &window)
    {
        Document &document = window.document();
        const AnalysisSettings before = document.settings();
        QTest::keyClick(&window, Qt::Key_Return, Qt::AltModifier); // all is visible, nothing happens
        QCOMPARE(document.settings(), before);
        document.viewport().zoomTo({30.0, document.viewport().full().time.high}, {20.0, 60.0});
        QTest::keyClick(&window, Qt::Key_Return, Qt::AltModifier);
        QVERIFY(settle(window));
        const SelectionSettings &part = document.settings().selection;
        QCOMPARE(part.fromSeconds, 30.0);
        QCOMPARE(part.toSeconds, before.selection.toSeconds); // the end was visible
        QCOMPARE(part.lowHz, 20.0);
        QCOMPARE(part.highHz, 60.0);
        QVERIFY(document.viewport().full().frequency.high < 61.0);
        document.undoStack().undo();
        QCOMPARE(document.settings(), before);
    }
};

FAINTLINE_WINDOW_TEST(tst_BoxAnalysis)
#include "tst_BoxAnalysis.moc"
