#include "app/document/Document.h"
#include "support/test.h"

#include <random>

using namespace faintline;

namespace {

AnalysisSettings withSnr(double snr)
{
    AnalysisSettings settings;
    settings.model.snr = snr;
    return settings;
}

/// Another value for a field, within its range.
FieldValue randomValue(const FieldInfo &info, std::mt19937 &random)
{
    const double fraction = std::uniform_real_distribution(0.0, 1.0)(random);
    const double number = info.minimum + fraction * (std::min(info.maximum, 1e3) - info.minimum);
    switch (info.kind) {
    case FieldKind::Flag:
        return fraction < 0.5;
    case FieldKind::Integer:
        return int(number);
    case FieldKind::Number:
        return number;
    case FieldKind::Choice:
        return info.choices[std::min(info.choices.size() - 1, std::size_t(fraction * double(info.choices.size())))];
    case FieldKind::Numbers:
        return std::vector<double>{number};
    }
    return 0.0;
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

    void twoHundredRandomEditsUndoneAreWhatTheyWere()
    {
        std::mt19937 random(5);
        Document document;
        std::vector<AnalysisSettings> history{document.settings()};
        const auto &fields = AnalysisSettings::fields();
        while (document.undoStack().count() < 200) {
            AnalysisSettings after = document.settings();
            const auto &field = fields[random() % fields.size()];
            field.set(after, randomValue(field, random));
            if (after == document.settings())
                continue;
            document.edit(after, QString::fromStdString(field.name));
            history.push_back(after);
        }
        for (std::size_t i = history.size(); i-- > 1;) {
            QCOMPARE(document.settings(), history[i]);
            document.undoStack().undo();
        }
        QCOMPARE(document.settings(), AnalysisSettings());
        document.undoStack().setIndex(200);
        QCOMPARE(document.settings(), history.back());
    }
};

FAINTLINE_TEST(tst_Document)
#include "tst_Document.moc"
