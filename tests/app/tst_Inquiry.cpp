#include "app/base/Inquiry.h"
#include "support/test.h"

#include <QLabel>

#include <atomic>

using namespace faintline;

namespace {

/// A panel that shows the square of a number, and counts how often it was
/// computed.
struct Squares : QWidget {
    using Asking = Inquiry<int, int>;

    Asking::Question question() const { return given; }
    void show(const int *answer) { shown << (answer ? QString::number(*answer) : m_square.whyNot()); }

    Asking::Question given = std::tuple(3);
    std::atomic<int> computed = 0;
    QStringList shown;
    QLabel label;
    Asking m_square{this, &Squares::question,
                    [this](int value, const RunContext &context) {
                        context.checkpoint(0.0, "squares");
                        ++computed;
                        if (value < 0)
                            throw Error("square", "requires a number that is not negative");
                        return value * value;
                    },
                    &Squares::show};
};

} // namespace

class tst_Inquiry : public QObject
{
    Q_OBJECT

private slots:
    void computesTheSameQuestionOnce()
    {
        Squares squares;
        squares.m_square.ask();
        squares.m_square.ask();
        settle(squares);
        squares.m_square.ask();
        settle(squares);
        QCOMPARE(squares.shown, QStringList("9"));
        QCOMPARE(squares.computed, 1);
        QCOMPARE(squares.m_square.answered(), std::tuple(3));
        QVERIFY(squares.m_square.answerAbout(3) && !squares.m_square.answerAbout(4));
    }

    void keepsTheAnswerUntilTheNewestQuestionIsAnswered()
    {
        Squares squares;
        squares.m_square.ask();
        settle(squares);
        for (int value = 4; value < 20; ++value) {
            squares.given = std::tuple(value);
            squares.m_square.ask();
            QCOMPARE(*squares.m_square.answer(), 9);
        }
        settle(squares);
        QCOMPARE(squares.shown, (QStringList{"9", "361"}));
    }

    void saysWhyThereIsNoAnswer()
    {
        Squares squares;
        squares.m_square.watch(squares, &squares.label);
        squares.QWidget::show();
        squares.m_square.ask();
        settle(squares);
        squares.given = QStringLiteral("No number.");
        squares.m_square.ask();
        QVERIFY(!squares.m_square.answer());
        QCOMPARE(squares.label.text(), QString("No number."));
        squares.given = std::tuple(-1);
        squares.m_square.ask();
        settle(squares);
        QVERIFY(!squares.m_square.answer());
        QVERIFY2(squares.label.text().contains("not negative"), qPrintable(squares.label.text()));
        QCOMPARE(squares.shown.size(), 3);
    }

    /// A former document's answer does not come after the reason why there is
    /// none.
    void dropsTheAnswerThatIsBeingComputed()
    {
        Squares squares;
        squares.m_square.ask();
        squares.given = QString();
        squares.m_square.ask();
        QVERIFY(!isBusy(squares));
        QTest::qWait(50);
        QCOMPARE(squares.shown, QStringList(QString()));
    }

    void leavesWhatIsShownWithoutQuestion()
    {
        Squares squares;
        squares.m_square.ask();
        settle(squares);
        squares.given = {};
        squares.m_square.ask();
        QCOMPARE(*squares.m_square.answer(), 9);
        squares.given = std::tuple(3); // asked again
        squares.m_square.ask();
        settle(squares);
        QCOMPARE(squares.computed, 2);
    }

    void computesWhileSeen()
    {
        Squares squares;
        squares.m_square.watch(squares);
        squares.m_square.ask();
        QVERIFY(!isBusy(squares));
        squares.QWidget::show();
        QVERIFY(QTest::qWaitFor([&] { return squares.m_square.answer() != nullptr; }));
        squares.hide();
        squares.given = std::tuple(4);
        squares.m_square.ask();
        QVERIFY(!isBusy(squares));
        QCOMPARE(squares.computed, 1);
        squares.given = QStringLiteral("Closed.");
        squares.m_square.ask();
        QVERIFY(!squares.m_square.answer());
    }

    void waitsWhileTheQuestionChanges()
    {
        Squares squares;
        squares.m_square.setPause(30);
        for (int value = 0; value < 5; ++value) {
            squares.given = std::tuple(value);
            squares.m_square.ask();
            QVERIFY(isBusy(squares));
        }
        settle(squares);
        QCOMPARE(squares.computed, 1);
        QCOMPARE(squares.shown, QStringList("16"));
    }

    void showsAnswersInParts()
    {
        QObject parent;
        QStringList shown;
        using Asking = Inquiry<QString, int>;
        Asking letters(
            &parent, [] { return Asking::Question(std::tuple(3)); },
            [](int count, const RunContext &, const Asking::Partly &partly) {
                QString text;
                for (int i = 0; i < count; ++i)
                    partly(text += QLatin1Char('a'));
                return text + QLatin1Char('.');
            },
            [&](const QString *text) { shown << *text; });
        letters.ask();
        settle(parent);
        QCOMPARE(shown, (QStringList{"a", "aa", "aaa", "aaa."}));
    }
};

FAINTLINE_WINDOW_TEST(tst_Inquiry)
#include "tst_Inquiry.moc"
