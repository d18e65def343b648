#include "base/files/fileName.h"
#include "support/test.h"

#include "base/oneLine.h"
#include "support/errors.h"

using namespace faintline;

/// Names of files are bytes; as text they come back as they were.
class tst_fileName : public QObject
{
    Q_OBJECT

private slots:
    void thereAndBack()
    {
        QCOMPARE(textFromFileName("½ plain"), std::string("½ plain"));
        QCOMPARE(textFromFileName("\xff"), std::string("\xf4\x8f\xbb\xbf"));             // U+10FEFF
        QCOMPARE(fileNameFromText("\xf4\x8f\xb7\xbf"), std::string("\xf4\x8f\xb7\xbf")); // U+10FDFF is another's
        const std::string itself = "a\xf4\x8f\xbb\xb0"; // U+10FEF0 in a name is four bytes, not one
        QVERIFY(fileNameFromText(textFromFileName(itself)) == itself);
        for (int first = 0; first < 256; ++first)
            for (int second = 0; second < 256; ++second) {
                const std::string name{'a', static_cast<char>(first), static_cast<char>(second)};
                const std::string text = textFromFileName(name);
                for (std::size_t i = 0; i < text.size(); i += characterLength(text, i))
                    QVERIFY(characterLength(text, i) > 0);
                QVERIFY(fileNameFromText(text) == name);
            }
    }

    void endings()
    {
        QVERIFY(hasEnding("a.CSV", ".csv") && !hasEnding("csv", ".csv") && !hasEnding("a.csv.svg", ".csv"));
        checkEnding("curve.csv", {".csv", ".jsonl"});
        QCOMPARE(test::errorOf([] {
                     checkEnding("curve.svg", {".csv", ".json", ".txt"});
                 }),
                 std::string("curve.svg: must end in .csv, .json or .txt"));
    }
};

FAINTLINE_TEST(tst_fileName)
#include "tst_fileName.moc"
