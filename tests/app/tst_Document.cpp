#include "app/document/Document.h"
#include "support/test.h"

using namespace faintline;

namespace {

AnalysisSettings withSnr(double snr)
{
    AnalysisSettings settings;
    settings.model.snr = snr;
    return settings;
}

} // namespace

class tst_Document : public QObject
{
    Q_OBJECT

private slots:
    void anEditCanBeUndoneAndRedone()
    {
        Document document;
        QSignalSpy changed(&document, &Document::settingsChanged);
        document.edit(withSnr(2.0), "Change the SNR");
        QCOMPARE(document.settings().model.snr, 2.0);
        QVERIFY(document.isModified());
        document.undoStack().undo();
        QCOMPARE(document.settings(), AnalysisSettings());
        QVERIFY(!document.isModified());
        document.undoStack().redo();
        QCOMPARE(document.settings(), withSnr(2.0));
        QCOMPARE(changed.count(), 3);
        QCOMPARE(document.undoStack().undoText(), "Change the SNR");
    }

    void anEditThatChangesNothingIsNone()
    {
        Document document;
        document.edit(document.settings(), "Nothing");
        QCOMPARE(document.undoStack().count(), 0);
    }

    void aGestureIsOneStep()
    {
        Document document;
        document.beginGesture();
        for (int i = 1; i <= 10; ++i)
            document.edit(withSnr(i), "Change the SNR", "model.snr");
        document.endGesture();
        QCOMPARE(document.undoStack().count(), 1);
        document.undoStack().undo();
        QCOMPARE(document.settings(), AnalysisSettings());
    }

    void otherFieldsAndGesturesAreStepsOfTheirOwn()
    {
        Document document;
        document.beginGesture();
        document.edit(withSnr(2.0), "Change the SNR", "model.snr");
        AnalysisSettings other = document.settings();
        other.noise.halfWidthCells = 30;
        document.edit(other, "Change the noise", "noise.halfWidthCells");
        QCOMPARE(document.undoStack().count(), 2);
        document.beginGesture(); // another key, at once
        other.noise.halfWidthCells = 31;
        document.edit(other, "Change the noise", "noise.halfWidthCells");
        QCOMPARE(document.undoStack().count(), 3);
        document.endGesture();
        for (int cells = 32; cells < 34; ++cells) { // by nobody's hand
            other.noise.halfWidthCells = cells;
            document.edit(other, "Change the noise", "noise.halfWidthCells");
        }
        QCOMPARE(document.undoStack().count(), 5);
    }

    void aGestureThatComesBackIsNone()
    {
        Document document;
        document.beginGesture();
        document.edit(withSnr(2.0), "Change the SNR", "model.snr");
        document.edit(AnalysisSettings(), "Change the SNR", "model.snr");
        QCOMPARE(document.undoStack().count(), 0);
        QVERIFY(!document.isModified());
    }
};

FAINTLINE_TEST(tst_Document)
#include "tst_Document.moc"
