#include "support/test.h"
#include "widgets/forms/FormSection.h"

#include "pixels.h"
#include "widgets/base/Theme.h"

#include <QCheckBox>
#include <QToolButton>
#include <QVBoxLayout>

using namespace faintline;

/// What a heading folds away, by mouse and by key.
class tst_FormSection : public QObject
{
    Q_OBJECT

private slots:
    void initTestCase() { Theme::apply(Theme::Kind::Light); }

    void init()
    {
        m_window = std::make_unique<QWidget>();
        auto *layout = new QVBoxLayout(m_window.get());
        m_section = new FormSection("Model");
        layout->addWidget(m_section);
        layout->addStretch(1);
        test::show(*m_window, {300, 400});
        QVERIFY(QTest::qWaitForWindowActive(m_window.get()));
    }

    void itBeginsOpenWithoutMore()
    {
        const QCheckBox *often = addRow("often");
        QVERIFY(often->isVisible());
        QVERIFY(!button("More")->isVisible()); // there is nothing in it
        const QCheckBox *seldom = addRow("seldom", true);
        QVERIFY(button("More")->isVisible());
        QVERIFY(!seldom->isVisible());
    }

    void rowsKeepTheirOrder()
    {
        const QCheckBox *seldom = addRow("seldom", true), *first = addRow("first"), *second = addRow("second");
        m_section->setMoreOpen(true);
        QCoreApplication::processEvents();
        const auto top = [&](const QWidget *row) { return row->mapTo(m_section, QPoint()).y(); };
        QVERIFY(top(button("Model")) < top(first));
        QVERIFY(top(first) < top(second));
        QVERIFY(top(second) < top(button("More"))); // however late it was added
        QVERIFY(top(button("More")) < top(seldom));
    }

    void aClickFoldsAndUnfolds()
    {
        const QCheckBox *often = addRow("often"), *seldom = addRow("seldom", true);
        click(button("Model"));
        QVERIFY(!often->isVisible());
        QCOMPARE(button("Model")->arrowType(), Qt::RightArrow);
        click(button("Model"));
        QVERIFY(often->isVisible());
        QCOMPARE(button("Model")->arrowType(), Qt::DownArrow);
        click(button("More"));
        QVERIFY(seldom->isVisible());
        QCOMPARE(button("More")->arrowType(), Qt::DownArrow);
        click(button("More"));
        QVERIFY(!seldom->isVisible());
    }

    void spaceFoldsAndUnfolds()
    {
        const QCheckBox *often = addRow("often");
        button("Model")->setFocus(Qt::TabFocusReason);
        QVERIFY(button("Model")->hasFocus());
        QTest::keyClick(button("Model"), Qt::Key_Space);
        QVERIFY(!often->isVisible());
        QVERIFY(button("Model")->hasFocus()); // so that it can be undone at once
        QTest::keyClick(button("Model"), Qt::Key_Space);
        QVERIFY(often->isVisible());
    }

    void whatIsFoldedTakesNoRoomAndNoFocus()
    {
        QCheckBox *seldom = addRow("seldom", true);
        auto *after = new QCheckBox("after");
        m_window->layout()->addWidget(after);
        after->show();
        const int open = m_section->sizeHint().height();
        m_section->setOpen(false);
        QCoreApplication::processEvents();
        QVERIFY(m_section->sizeHint().height() < open);
        QCOMPARE(m_section->sizeHint().height(), button("Model")->sizeHint().height());
        button("Model")->setFocus();
        QTest::keyClick(button("Model"), Qt::Key_Tab);
        QVERIFY(after->hasFocus());
        m_section->reveal(seldom);
        button("Model")->setFocus();
        QTest::keyClick(button("Model"), Qt::Key_Tab);
        QVERIFY(button("More")->hasFocus());
        QTest::keyClick(button("More"), Qt::Key_Tab);
        QVERIFY(seldom->hasFocus());
    }

    void moreStaysAsItWasWhileTheSectionIsFolded()
    {
        const QCheckBox *seldom = addRow("seldom", true);
        m_section->setMoreOpen(true);
        m_section->setOpen(false);
        QVERIFY(!seldom->isVisible());
        m_section->setOpen(true);
        QVERIFY(seldom->isVisible());
    }

    void revealOpensWhatIsInTheWay()
    {
        QCheckBox *often = addRow("often"), *seldom = addRow("seldom", true);
        m_section->setOpen(false);
        m_section->reveal(often);
        QVERIFY(often->isVisible() && !seldom->isVisible()); // and nothing else
        m_section->setOpen(false);
        m_section->reveal(seldom);
        QVERIFY(often->isVisible() && seldom->isVisible());
        QVERIFY(button("More")->isChecked());
    }

    void headingsCanBeHeard()
    {
        QCOMPARE(button("Model")->accessibleName(), QString("Section Model"));
        QCOMPARE(button("More")->accessibleName(), QString("More of Model"));
        for (const char *name : {"Model", "More"})
            QVERIFY(button(name)->focusPolicy() & Qt::TabFocus);
    }

private:
    QCheckBox *addRow(const QString &name, bool isAdvanced = false)
    {
        auto *row = new QCheckBox(name);
        m_section->addRow(row, isAdvanced);
        QCoreApplication::processEvents();
        return row;
    }
    QToolButton *button(const QString &text) const
    {
        for (QToolButton *found : m_section->findChildren<QToolButton *>())
            if (found->text() == text)
                return found;
        return nullptr;
    }
    static void click(QToolButton *button)
    {
        QTest::mouseClick(button, Qt::LeftButton);
        QCoreApplication::processEvents();
    }

    std::unique_ptr<QWidget> m_window;
    FormSection *m_section = nullptr;
};

FAINTLINE_WINDOW_TEST(tst_FormSection)
#include "tst_FormSection.moc"
