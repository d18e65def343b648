#include "base/oneLine.h"

#include <QtTest>

using namespace faintline;

/// Foreign text made fit for a row of a table or a message.
class tst_oneLine : public QObject
{
    Q_OBJECT

private slots:
    void isCleanText();
    void longTextLosesItsMiddle();
};

void tst_oneLine::isCleanText()
{
    QCOMPARE(oneLine(" a\tb\nc\x7f "), std::string("a b c"));
    QCOMPARE(oneLine("½ \xf0\x9f\x8e\xb5"), std::string("½ \xf0\x9f\x8e\xb5"));
    QCOMPARE(oneLine("\xff\xc3(\xe2\x82"), std::string("?" "?(?" "?"));
    QCOMPARE(oneLine("\xed\xa0\x80"), std::string("???")); // a surrogate
    QCOMPARE(oneLine("\xc0\xaf"), std::string("??"));       // an overlong form
}

void tst_oneLine::longTextLosesItsMiddle()
{
    QCOMPARE(oneLine("abcdefgh", 8), std::string("abcdefgh"));
    QCOMPARE(oneLine("abcdefghi", 8), std::string("abcd … fghi"));
    QCOMPARE(oneLine("½½½½½½", 6), std::string("½ … ½½")); // never within a character
}

QTEST_APPLESS_MAIN(tst_oneLine)
#include "tst_oneLine.moc"
