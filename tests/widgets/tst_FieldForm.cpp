#include "base/Error.h"
#include "scene/LineScene.h"
#include "support/test.h"
#include "widgets/forms/FieldForm.h"

#include <QLabel>
#include <QLineEdit>

using namespace faintline;

class tst_FieldForm : public QObject
{
    Q_OBJECT

private slots:
    void mainFieldsComeFirstAndTheOthersAreFolded()
    {
        const auto fields = withMainFields(LineSettings::fields(), {"frequencyHz", "snrDb"});
        QCOMPARE(fields.size(), LineSettings::fields().size());
        QCOMPARE(fields[0].name, std::string("frequencyHz"));
        QCOMPARE(fields[1].name, std::string("snrDb"));
        QVERIFY(!fields[0].isAdvanced && !fields[1].isAdvanced);
        FieldForm<LineSettings> form("Line", fields);
        form.show();
        QVERIFY(form.editor("snrDb")->isVisible());
        QVERIFY(!form.editor("fading")->isVisible());
        QVERIFY(!form.editor("no such field"));
    }

    void anEditLeavesAllOtherValues()
    {
        FieldForm<LineSettings> form("Line");
        LineSettings line;
        line.fading = Fading::Rayleigh;
        line.snrDb = 3.0;
        form.setValue(line);
        QSignalSpy edited(&form, &FieldFormBase::edited);
        auto *editor = qobject_cast<QLineEdit *>(form.editor("snrDb"));
        QCOMPARE(editor->text(), QString("3"));
        editor->selectAll();
        QTest::keyClicks(editor, "7.5");
        QTest::keyClick(editor, Qt::Key_Return);
        QCOMPARE(edited.size(), 1);
        line.snrDb = 7.5;
        QCOMPARE(form.value(), line);
        editor->selectAll();
        QTest::keyClicks(editor, "1000"); // above the table's limit
        QTest::keyClick(editor, Qt::Key_Return);
        QVERIFY(form.isRefused());
        QCOMPARE(form.value(), line);
        form.clearErrors(); // as an edit of another row does
        QVERIFY(std::ranges::any_of(form.findChildren<QLabel *>(),
                                    [](const QLabel *one) { return one->text().contains("120"); }));
        form.setValue(line);
        QVERIFY(!form.isRefused());
    }

    void anErrorIsShownUnderItsField()
    {
        FieldForm<LineSettings> form("Line");
        form.show();
        const auto shows = [&](const QString &text) {
            const auto labels = form.findChildren<QLabel *>();
            return std::ranges::any_of(
                labels, [&](const QLabel *one) { return one->isVisible() && one->text().contains(text); });
        };
        form.showError(Error("line.snrDb = 1", "is too loud").ofField("snrDb"));
        QVERIFY(shows("is too loud"));
        form.showError(Error("lines", "are too many"));
        QVERIFY(shows("are too many"));
        form.clearErrors();
        QVERIFY(!shows("too"));
    }
};

FAINTLINE_WINDOW_TEST(tst_FieldForm)
#include "tst_FieldForm.moc"
