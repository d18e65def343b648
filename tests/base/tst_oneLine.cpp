#include "base/oneLine.h"
#include "support/test.h"

using namespace faintline;

/// Foreign text made fit for a row of a table or a message.
class tst_oneLine : public QObject
{
    Q_OBJECT

private slots:
    void isCleanText()
    {
        QCOMPARE(oneLine(" a\tb\nc\x7f "), std::string("a b c"));
        QCOMPARE(oneLine("½ \xf0\x9f\x8e\xb5"), std::string("½ \xf0\x9f\x8e\xb5"));
        QCOMPARE(oneLine("\xff\xc3(\xe2\x82"), std::string("?"
                                                           "?(?"
                                                           "?"));
        QCOMPARE(oneLine("\xed\xa0\x80"), std::string("???")); // a surrogate
        QCOMPARE(oneLine("\xc0\xaf"), std::string("??"));      // an overlong form
    }

    void nothingThatCommands()
    {
        QCOMPARE(oneLine("a\x1b[31mb"), std::string("a [31mb"));
        QCOMPARE(oneLine("a\xc2\x80\xc2\x9b\xc2\x9f\xc2\xa0z"),
                 std::string("a   \xc2\xa0z")); // C1, and a space that does not break
        // Marks, line ends, embeddings and overrides, isolates, and their neighbours.
        QCOMPARE(oneLine("a\xd8\x9c\xe2\x80\x8e\xe2\x80\x8f\xe2\x80\xa8\xe2\x80\xae\xe2\x81\xa6\xe2\x81\xa9z"),
                 std::string("a       z"));
        for (const char *harmless :
             {"\xe2\x80\x8d", "\xe2\x80\xa6", "\xe2\x80\xaf", "\xe2\x81\xa4", "\xe2\x81\xaa", "\xd8\x9b"})
            QCOMPARE(oneLine(harmless), std::string(harmless));
    }

    void longTextLosesItsMiddle()
    {
        QCOMPARE(oneLine("abcdefgh", 8), std::string("abcdefgh"));
        QCOMPARE(oneLine("abcdefghi", 8), std::string("abcd … fghi"));
        QCOMPARE(oneLine("½½½½½½", 6), std::string("½ … ½½")); // never within a character
    }

    void aBeginningIsWholeCharacters()
    {
        QCOMPARE(beginning("abc", 3), std::string("abc"));
        QCOMPARE(beginning("abc", 2), std::string("ab"));
        const std::string note("\xf0\x9f\x8e\xb5");
        for (std::size_t bytes = 0; bytes < 4; ++bytes)
            QCOMPARE(beginning("a" + note, 1 + bytes), std::string("a"));
        QCOMPARE(beginning("a" + note, 5), "a" + note);
    }
};

FAINTLINE_TEST(tst_oneLine)
#include "tst_oneLine.moc"
