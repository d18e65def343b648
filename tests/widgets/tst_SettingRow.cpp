#include "support/test.h"
#include "widgets/forms/SettingRow.h"

#include "widgets/base/Theme.h"

#include <QComboBox>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QSpinBox>
#include <QToolButton>
#include <QVBoxLayout>

#include <limits>

using namespace faintline;

namespace {

FieldInfo info(FieldKind kind, double minimum = 0.0, double maximum = 0.0)
{
    FieldInfo made;
    made.name = "stage.setting";
    made.sentence = "What it does where a < b.";
    made.kind = kind;
    made.minimum = minimum;
    made.maximum = maximum;
    return made;
}

FieldInfo seconds()
{
    FieldInfo made = info(FieldKind::Number, -10.0, 10.0);
    made.unit = "s";
    return made;
}

FieldInfo shape()
{
    FieldInfo made = info(FieldKind::Choice);
    made.choices = {"hann", "rectangular", "blackmanHarris"};
    return made;
}

} // namespace

/// One setting: what is typed comes out as a value in range or as an error beside it, and what is shown reads back.
class tst_SettingRow : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }
    void cleanup() { m_window.reset(); }

    void numbersAsTheyAreTyped_data()
    {
        QTest::addColumn<QString>("text");
        QTest::addColumn<double>("value");
        QTest::newRow("plain") << "2.5" << 2.5;
        QTest::newRow("with a comma") << "2,5" << 2.5;
        QTest::newRow("with a true minus") << QString::fromUtf8("−2.5") << -2.5;
        QTest::newRow("with a plus") << "+3" << 3.0;
        QTest::newRow("with blanks") << "  4 " << 4.0;
        QTest::newRow("with an exponent") << "1e-3" << 0.001;
        QTest::newRow("the least") << "-10" << -10.0;
        QTest::newRow("the largest") << "10" << 10.0;
    }

    void numbersAsTheyAreTyped()
    {
        QFETCH(QString, text);
        QFETCH(double, value);
        QSignalSpy edited(&make(seconds(), 1.0), &SettingRow::edited);
        type(text);
        QCOMPARE(edited.count(), 1);
        QCOMPARE(edited[0][0].value<FieldValue>(), FieldValue(value));
        QCOMPARE(error(), QString());
    }

    void whatIsNoNumberInRangeIsRefused_data()
    {
        QTest::addColumn<QString>("text");
        for (const char *text : {"", "loud", "10.001", "-1e308", "1e999", "nan", "inf", "1.2.3", "3 s", "0x10"})
            QTest::newRow(*text ? text : "nothing") << QString(text);
    }

    void whatIsNoNumberInRangeIsRefused()
    {
        QFETCH(QString, text);
        QSignalSpy edited(&make(seconds(), 1.0), &SettingRow::edited);
        type("5");
        type(text.isEmpty() ? " " : text);
        QCOMPARE(edited.count(), 1);
        QVERIFY2(error().contains("-10 … 10 s") || error().contains("number"), qPrintable(error()));
        type("6"); // and the next one is taken
        QCOMPARE(edited.count(), 2);
        QCOMPARE(error(), QString());
    }

    void tellsWhatIsNoNumberFromWhatIsOutOfRange()
    {
        make(seconds(), 1.0);
        type("loud");
        QCOMPARE(error(), "must be a number");
        type("11");
        QVERIFY2(error().contains("-10 … 10 s"), qPrintable(error()));
    }

    /// 48 or 48000: the one would be as bad a guess as the other.
    void aCommaBeforeThreeDigitsIsRefused()
    {
        SettingRow &row = make(info(FieldKind::Number, 0.0, 1e6), 1.0);
        QSignalSpy edited(&row, &SettingRow::edited);
        type("48,000");
        QVERIFY2(error().endsWith("write 48000 or 48.000"), qPrintable(error()));
        QVERIFY(row.isRefused() && edited.isEmpty());
        type("0,125");
        QCOMPARE(edited.last()[0].value<FieldValue>(), FieldValue(0.125));
    }

    void whatIsTypedCountsAtOnceIfItIsTracked()
    {
        SettingRow &row = make(info(FieldKind::Number, 0.0, 100.0), 1.0);
        row.setTracking(true);
        QSignalSpy edited(&row, &SettingRow::edited);
        auto *edit = qobject_cast<QLineEdit *>(row.editor());
        edit->clear();
        QTest::keyClicks(edit, "2.50");
        QCOMPARE(edited.last()[0].value<FieldValue>(), FieldValue(2.5));
        QCOMPARE(edit->text(), "2.50"); // as it was typed
        QTest::keyClicks(edit, "x");
        QVERIFY(row.isRefused());
        QTest::keyClick(edit, Qt::Key_Backspace);
        QVERIFY(!row.isRefused());
        QTest::keyClick(edit, Qt::Key_Return);
        QCOMPARE(edit->text(), "2.5");
    }

    void everyNumberReadsBack_data()
    {
        QTest::addColumn<double>("value");
        for (const double value :
             {0.0, 1.0 / 3.0, 145500000.0, 14095600.5, 12345.125, -2.0 / 7.0, 0.1, 1e-12, 123456.789, 6.02214076e23,
              -0.5, std::numeric_limits<double>::denorm_min(), std::numeric_limits<double>::max()})
            QTest::addRow("%.17g", value) << value;
    }

    void everyNumberReadsBack()
    {
        QFETCH(double, value);
        constexpr double any = std::numeric_limits<double>::max();
        SettingRow &row = make(info(FieldKind::Number, -any, any), 99.0);
        row.setValue(value);
        const QString text = shown();
        row.setValue(99.0);
        QSignalSpy edited(&row, &SettingRow::edited);
        type(text);
        QCOMPARE(edited.count(), 1);
        QCOMPARE(edited[0][0].value<FieldValue>(), FieldValue(value)); // to the last bit
    }

    void listsKeepTheirCommas()
    {
        QSignalSpy edited(&make(info(FieldKind::Numbers, 0.0, 1.0), std::vector<double>{1.0}), &SettingRow::edited);
        type("0.5, 0.25");
        type("1/3,1/3");
        QCOMPARE(edited.count(), 2);
        QCOMPARE(edited[0][0].value<FieldValue>(), FieldValue(std::vector{0.5, 0.25}));
        QCOMPARE(edited[1][0].value<FieldValue>(), FieldValue(std::vector{1.0 / 3.0, 1.0 / 3.0}));
        QCOMPARE(shown(), QString("1/3, 1/3"));
        type("0.5, 2");
        QCOMPARE(edited.count(), 2);
        QVERIFY(!error().isEmpty());
    }

    void integersAreEmittedWhenTheyAreWhole()
    {
        SettingRow &row = make(info(FieldKind::Integer, 1.0, 64.0), 8);
        QSignalSpy edited(&row, &SettingRow::edited);
        type("16"); // not first 1, then 16
        QCOMPARE(edited.count(), 1);
        QCOMPARE(edited[0][0].value<FieldValue>(), FieldValue(16));
        QTest::keyClick(row.editor(), Qt::Key_Up);
        QCOMPARE(edited.last()[0].value<FieldValue>(), FieldValue(17));
        qobject_cast<QSpinBox *>(row.editor())->setValue(1000);
        QCOMPARE(edited.last()[0].value<FieldValue>(), FieldValue(64));
    }

    void choicesGoByTheirNames()
    {
        SettingRow &row = make(shape(), std::string("hann"));
        auto *box = qobject_cast<QComboBox *>(row.editor());
        QVERIFY(box);
        QCOMPARE(box->count(), 3);
        QSignalSpy edited(&row, &SettingRow::edited);
        box->setFocus();
        QTest::keyClick(box, Qt::Key_End);
        QCOMPARE(edited.count(), 1);
        QCOMPARE(edited[0][0].value<FieldValue>(), FieldValue(std::string("blackmanHarris")));
        QVERIFY(box->currentText() != "blackmanHarris"); // that is for files
        row.setValue(std::string("rectangular"));
        QCOMPARE(box->currentIndex(), 1);
        QCOMPARE(edited.count(), 1);
    }

    /// Two settings whose values share a name in files.
    void aChoiceIsNamedBySetting()
    {
        FieldInfo likelihood = info(FieldKind::Choice);
        likelihood.name = "model.likelihood";
        likelihood.choices = {"rice", "exponential"};
        QCOMPARE(qobject_cast<QComboBox *>(make(likelihood, std::string("rice")).editor())->itemText(1),
                 QString("fluctuating"));
        FieldInfo weights = info(FieldKind::Choice);
        weights.name = "integrator.shape";
        weights.choices = {"boxcar", "exponential"};
        SettingRow &row = make(weights, std::string("exponential"));
        QCOMPARE(qobject_cast<QComboBox *>(row.editor())->itemText(1), QString("exponential"));
        QVERIFY(row.editor()->toolTip().contains("Default: exponential"));
    }

    void aZeroThatIsNoSizeIsAWord()
    {
        FieldInfo length = seconds();
        length.words = {{0.0, "automatic"}};
        SettingRow row(length, 0.0);
        auto *line = qobject_cast<QLineEdit *>(row.editor());
        QCOMPARE(line->text(), QString("automatic"));
        QVERIFY(line->toolTip().contains("Default: automatic<"));
        QSignalSpy edited(&row, &SettingRow::edited);
        line->setText("2");
        line->setModified(true);
        emit line->editingFinished();
        QCOMPARE(std::get<double>(edited.takeFirst()[0].value<FieldValue>()), 2.0);
        for (const char *text : {"Automatic", "0"}) {
            row.setValue(2.0);
            QCOMPARE(line->text(), QString("2"));
            line->setText(text);
            line->setModified(true);
            emit line->editingFinished();
            QCOMPARE(std::get<double>(edited.takeFirst()[0].value<FieldValue>()), 0.0);
            QCOMPARE(line->text(), QString("automatic"));
        }
    }

    void flagsByKey()
    {
        SettingRow &row = make(info(FieldKind::Flag), false);
        QSignalSpy edited(&row, &SettingRow::edited);
        row.editor()->setFocus();
        QTest::keyClick(row.editor(), Qt::Key_Space);
        QTest::keyClick(row.editor(), Qt::Key_Space);
        QCOMPARE(edited.count(), 2);
        QCOMPARE(edited[0][0].value<FieldValue>(), FieldValue(true));
        QCOMPARE(edited[1][0].value<FieldValue>(), FieldValue(false));
    }

    void aMistakeIsForgottenWithIt_data()
    {
        QTest::addColumn<double>("stepsInOne");
        QTest::newRow("a field") << 0.0;
        QTest::newRow("a field with arrows") << 4.0;
    }

    void aMistakeIsForgottenWithIt()
    {
        QFETCH(double, stepsInOne);
        SettingRow &row = make(seconds(), 1.0, stepsInOne);
        QSignalSpy edited(&row, &SettingRow::edited);
        type("11");
        QVERIFY(!error().isEmpty());
        QCOMPARE(row.editor()->palette().color(QPalette::Text), Theme::colours(row).error);
        type("1"); // as it was
        QCOMPARE(error(), QString());
        QVERIFY(row.editor()->palette().color(QPalette::Text) != Theme::colours(row).error);
        QCOMPARE(edited.count(), 0);
        row.setError("must be less than the other one");
        row.editor()->clearFocus();
        row.editor()->setFocus();
        QTest::keyClick(row.editor(), Qt::Key_Return); // what others say of it is not answered by a visit
        QCOMPARE(error(), QString("must be less than the other one"));
    }

    void whatIsShownFromOutsideEmitsNothing()
    {
        const std::pair<FieldInfo, std::pair<FieldValue, FieldValue>> kinds[] = {
            {info(FieldKind::Flag), {false, true}},
            {info(FieldKind::Integer, 0.0, 9.0), {1, 2}},
            {seconds(), {1.0, 2.0}},
            {info(FieldKind::Numbers, 0.0, 9.0), {std::vector{1.0}, std::vector{2.0, 3.0}}},
            {shape(), {std::string("hann"), std::string("rectangular")}}};
        for (const auto &[field, values] : kinds) {
            SettingRow &row = make(field, values.first);
            QSignalSpy edited(&row, &SettingRow::edited);
            row.setValue(values.second);
            row.editor()->setFocus();
            row.editor()->clearFocus(); // an editor that is only visited
            QCOMPARE(edited.count(), 0);
        }
    }

    void theDefaultIsOneClickAway()
    {
        SettingRow &row = make(seconds(), 1.0);
        QSignalSpy edited(&row, &SettingRow::edited);
        auto *reset = row.findChild<QToolButton *>();
        QVERIFY(reset && !reset->isVisible());
        row.setLabelWidth(108);
        QCoreApplication::processEvents();
        const int width = row.editor()->width();
        type("5");
        QVERIFY(reset->isVisible());
        QCoreApplication::processEvents();
        QCOMPARE(row.editor()->width(), width); // its width is reserved
        type("50");                             // a mistake as well
        QTest::mouseClick(reset, Qt::LeftButton);
        QCOMPARE(edited.last()[0].value<FieldValue>(), FieldValue(1.0));
        QCOMPARE(shown(), QString("1"));
        QCOMPARE(error(), QString());
        QVERIFY(!reset->isVisible());
    }

    void whatIsNotTheDefaultIsBold()
    {
        SettingRow &row = make(seconds(), 1.0);
        QVERIFY(!row.label()->font().bold());
        row.setValue(2.0);
        QVERIFY(row.label()->font().bold());
        row.setValue(1.0);
        QVERIFY(!row.label()->font().bold());
    }

    void arrowsEndAtTheRange()
    {
        SettingRow &row = make(seconds(), 9.5, 4.0);
        QSignalSpy edited(&row, &SettingRow::edited);
        row.editor()->setFocus();
        for (int i = 0; i < 5; ++i)
            QTest::keyClick(row.editor(), Qt::Key_Up);
        QCOMPARE(edited.count(), 2); // 9.75, 10, and there is no more
        QCOMPARE(edited.last()[0].value<FieldValue>(), FieldValue(10.0));
        QTest::keyClick(row.editor(), Qt::Key_PageDown); // ten steps
        QCOMPARE(edited.last()[0].value<FieldValue>(), FieldValue(7.5));
    }

    void anotherUnitIsAnotherRange()
    {
        SettingRow &row = make(seconds(), 1.0);
        QSignalSpy edited(&row, &SettingRow::edited);
        type("11");
        QCOMPARE(edited.count(), 0);
        row.setUnit("min", 600.0);
        type("11");
        QCOMPARE(edited.count(), 1);
        type("-601");
        QVERIFY2(error().contains("-600 … 600 min"), qPrintable(error()));
        QVERIFY(row.editor()->toolTip().contains("-600 … 600 min"));
        QCOMPARE(row.editor()->accessibleName(), QString("Setting in min"));
        const auto labels = row.findChildren<QLabel *>();
        QVERIFY(std::any_of(labels.begin(), labels.end(),
                            [](const QLabel *label) { return label->isVisible() && label->text() == "min"; }));
    }

    void theErrorStandsBeforeTheNote()
    {
        SettingRow &row = make(seconds(), 1.0);
        const auto isShown = [&](const QString &text) {
            const auto labels = row.findChildren<QLabel *>();
            return std::any_of(labels.begin(), labels.end(),
                               [&](const QLabel *label) { return label->isVisible() && label->text() == text; });
        };
        row.setNote("16 Hz/s here");
        QVERIFY(isShown("16 Hz/s here"));
        QCOMPARE(error(), QString());
        row.setError("<b>must</b> be less");
        QVERIFY(!isShown("16 Hz/s here"));
        QCOMPARE(error(), QString("<b>must</b> be less"));
        for (const QLabel *label : row.findChildren<QLabel *>())
            if (label->text() == error())
                QCOMPARE(label->textFormat(), Qt::PlainText);
        row.setError({});
        QVERIFY(isShown("16 Hz/s here"));
    }

    void everyEditorCanBeHeard()
    {
        SettingRow &row = make(seconds(), 1.0);
        QCOMPARE(row.editor()->accessibleName(), QString("Setting in s"));
        QCOMPARE(row.editor()->accessibleDescription(), QString("What it does where a < b."));
        QCOMPARE(row.label()->buddy(), row.editor());
        QCOMPARE(row.findChild<QToolButton *>()->accessibleName(), QString("Reset Setting to its default"));
        QCOMPARE(make(info(FieldKind::Flag), false).editor()->accessibleName(), QString("Setting"));
    }

    void theToolTipTellsRangeAndDefault()
    {
        const QString number = make(seconds(), 1.0).editor()->toolTip();
        QVERIFY2(number.contains("Range: -10 … 10 s"), qPrintable(number));
        QVERIFY2(number.contains("Default: 1 s"), qPrintable(number));
        QVERIFY2(number.contains("a &lt; b"), qPrintable(number)); // it is HTML
        QVERIFY2(number.contains("stage.setting"), qPrintable(number));
        const QString flag = make(info(FieldKind::Flag), true).editor()->toolTip();
        QVERIFY2(flag.contains("Default: on") && !flag.contains("Range"), qPrintable(flag));
    }

    void tabGoesFromEditorToEditor()
    {
        SettingRow &row = make(seconds(), 1.0);
        auto *next = new SettingRow(info(FieldKind::Flag), false);
        m_window->layout()->addWidget(next);
        next->show();
        row.editor()->setFocus();
        QTest::keyClick(row.editor(), Qt::Key_Tab);
        QCOMPARE(QApplication::focusWidget(), next->editor());
        QTest::keyClick(next->editor(), Qt::Key_Backtab);
        QCOMPARE(QApplication::focusWidget(), row.editor());
    }

    void aThemeColoursItsErrors()
    {
        SettingRow &row = make(seconds(), 1.0);
        type("11");
        m_window->setPalette(Theme::palette(Theme::Kind::Dark));
        QCOMPARE(Theme::colours(row).error, Theme::colours(Theme::Kind::Dark).error);
        QVERIFY(!error().isEmpty());
        QCOMPARE(row.editor()->palette().color(QPalette::Text), Theme::colours(Theme::Kind::Dark).error);
    }

private:
    SettingRow &make(const FieldInfo &field, const FieldValue &defaultValue, double stepsInOne = 0.0)
    {
        m_window = std::make_unique<QWidget>();
        auto *layout = new QVBoxLayout(m_window.get());
        m_row = new SettingRow(field, defaultValue, stepsInOne);
        layout->addWidget(m_row);
        m_window->resize(300, 100);
        m_window->show();
        if (!QTest::qWaitForWindowActive(m_window.get()))
            QTest::qFail("no active window", __FILE__, __LINE__);
        return *m_row;
    }
    void type(const QString &text) const
    {
        QWidget *editor = m_row->editor();
        editor->setFocus();
        QTest::keyClick(editor, Qt::Key_A, Qt::ControlModifier);
        for (const QChar letter : text) { // QTest::keyClicks knows ASCII alone
            QKeyEvent press(QEvent::KeyPress, Qt::Key_unknown, Qt::NoModifier, letter);
            QCoreApplication::sendEvent(editor, &press);
        }
        QTest::keyClick(editor, Qt::Key_Return);
    }
    QString error() const
    {
        for (const QLabel *label : m_row->findChildren<QLabel *>())
            if (label->isVisible() && label->palette().color(QPalette::WindowText) == Theme::colours(*m_row).error)
                return label->text();
        return {};
    }
    QString shown() const
    {
        if (const auto *spin = qobject_cast<QAbstractSpinBox *>(m_row->editor()))
            return spin->text();
        return qobject_cast<QLineEdit *>(m_row->editor())->text();
    }

    std::unique_ptr<QWidget> m_window;
    SettingRow *m_row = nullptr;
};

FAINTLINE_WINDOW_TEST(tst_SettingRow)
#include "tst_SettingRow.moc"
