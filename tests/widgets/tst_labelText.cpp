#include "support/test.h"
#include "widgets/base/labelText.h"

#include <QLabel>

#include <memory>

using namespace faintline;

class tst_labelText : public QObject
{
    Q_OBJECT

private slots:
    void isOneLineWithoutControls()
    {
        QCOMPARE(labelText(std::string("a\nb\x1b[31m")), QStringLiteral("a b [31m"));
        QCOMPARE(labelText(QStringLiteral("wav\u202Egnp.exe\u0085")), QStringLiteral("wav gnp.exe"));
        QCOMPARE(buttonText(QStringLiteral("a&b")), QStringLiteral("a&&b"));
    }

    void isShortenedInItsMiddle()
    {
        QCOMPARE(labelText(std::string("abcdefghij"), 10), QStringLiteral("abcdefghij"));
        QCOMPARE(labelText(std::string("abcdefghijk"), 10), QStringLiteral("abcde…hijk"));
        QCOMPARE(labelText(std::string(250, 'x')).size(), mostLabelLetters);
    }

    void cutsNoCharacterInTwo()
    {
        QString text;
        for (int i = 0; i < 20; ++i)
            text += QStringLiteral("𝄞"); // two units each
        for (int most = 8; most < 14; ++most)
            QVERIFY(labelText(text, most).isValidUtf16());
    }

    void keepsWhatFitsInAMessage()
    {
        const std::string plain = "/home/somebody/recordings/quiet.wav: cannot be read";
        QCOMPARE(messageText(plain).toStdString(), plain);
        const QString shown = messageText("/home/" + std::string(250, 'x') + ".wav: cannot be read");
        QVERIFY(shown.startsWith(QLatin1String("/home/xxx"))
                && shown.endsWith(QLatin1String("xxx.wav: cannot be read")));
        QVERIFY(shown.size() < 100);
    }

    void keepsParagraphs()
    {
        QCOMPARE(paragraphs("one\x1b\ntwo\n\nfour"), QStringLiteral("one\ntwo\n\nfour"));
        QCOMPARE(paragraphs({}), QString());
    }

    void showsTagsLetterByLetter()
    {
        QCOMPARE(asHtml(QStringLiteral("<h1>a</h1>")), QStringLiteral("<qt>&lt;h1&gt;a&lt;/h1&gt;</qt>"));
        const std::unique_ptr<QLabel> label(plainLabel());
        QCOMPARE(label->textFormat(), Qt::PlainText);
    }
};

FAINTLINE_WINDOW_TEST(tst_labelText)
#include "tst_labelText.moc"
