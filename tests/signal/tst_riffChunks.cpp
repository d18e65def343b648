#include "signal/formats/riffChunks.h"
#include "support/test.h"

using namespace faintline;

namespace {

QByteArray number(std::uint32_t value, bool isBigEndian = false)
{
    QByteArray text;
    for (int i = 0; i < 4; ++i)
        text.append(char(value >> (8 * (isBigEndian ? 3 - i : i)) & 0xff));
    return text;
}

/// Twelve bytes of a file's head, then the list.
QByteArray fileWith(const QByteArray &list, bool isBigEndian = false)
{
    return QByteArray(isBigEndian ? "RIFX" : "RIFF") + number(1000, isBigEndian) + "WAVE" + "LIST"
           + number(std::uint32_t(list.size()), isBigEndian) + list;
}

} // namespace

/// Lists of a RIFF file whose lengths would lead a parser of 32 bits backwards.
class tst_riffChunks : public QObject
{
    Q_OBJECT

private slots:
    void lists_data()
    {
        QTest::addColumn<QByteArray>("file");
        QTest::addColumn<bool>("isBad");
        const QByteArray name = "INAM" + number(4) + "abcd";
        const QByteArray odd = "IART" + number(3) + QByteArray("abc\0", 4);
        const QByteArray back = "IART" + number(0xfffffff4) + "abc"; // behind its twelve bytes: 2³²
        QTest::newRow("names") << fileWith("INFO" + name + odd + name) << false;
        QTest::newRow("labels") << fileWith("adtl" + QByteArray("labl") + number(8) + QByteArray(8, 'x')) << false;
        QTest::newRow("empty") << fileWith({}) << false;
        QTest::newRow("backwards") << fileWith("INFO" + back) << true;
        QTest::newRow("backwards by its padding") << fileWith("INFO" + QByteArray("IART") + number(0xfffffff3)) << true;
        QTest::newRow("just not backwards") << fileWith("INFO" + QByteArray("IART") + number(0xfffffff2)) << false;
        QTest::newRow("backwards behind an odd one") << fileWith("INFO" + odd + back) << true;
        QTest::newRow("the padding alone leads beyond")
            << fileWith("INFO" + QByteArray("IART") + number(0xffffffff)) << true;
        QTest::newRow("photographs") << fileWith("exif" + name) << true;
        QTest::newRow("behind data") << fileWith("INFO" + QByteArray("data") + back) << false;
        QTest::newRow("behind zeros") << fileWith("INFO" + QByteArray(4, '\0') + back) << false;
        QTest::newRow("big-endian") << fileWith("INFO" + QByteArray("IART") + number(0xfffffff4, true), true) << true;
        QTest::newRow("small number of the other order")
            << fileWith("INFO" + QByteArray("INAM") + number(4, true) + "abcd", true) << false;
    }

    void lists()
    {
        QFETCH(QByteArray, file);
        QFETCH(bool, isBad);
        QCOMPARE(leads(file, 12), isBad);
    }

    void aCutFileIsHarmless()
    {
        const QByteArray file = fileWith("INFO" + QByteArray("INAM") + number(4) + "abcd");
        for (qsizetype length = 0; length <= file.size(); ++length)
            QVERIFY2(!leads(file.first(length), 12), qPrintable(QString::number(length)));
        QVERIFY(!leads(file, 5000)); // a chunk beyond the end
    }

private:
    bool leads(const QByteArray &file, Index chunk)
    {
        QFile written(m_folder.filePath("file.wav"));
        if (!written.open(QIODevice::WriteOnly) || written.write(file) != file.size())
            qFatal("cannot write");
        written.close();
        return leadsBackwards(FileBytes(written.fileName().toStdString()), chunk);
    }

    QTemporaryDir m_folder;
};

FAINTLINE_TEST(tst_riffChunks)
#include "tst_riffChunks.moc"
