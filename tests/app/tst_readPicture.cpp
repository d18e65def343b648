#include "app/document/Provenance.h"
#include "app/headless/readPicture.h"
#include "base/Error.h"
#include "support/test.h"

#include <sys/resource.h>

using namespace faintline;

namespace {

/// Largest memory of this process so far, in kB.
long mostMemory()
{
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

QImage smallPicture(const QString &provenance)
{
    QImage picture(4, 3, QImage::Format_RGB32);
    picture.fill(QColor(10, 200, 30));
    picture.setText(pictureProvenanceKey(), provenance);
    return picture;
}

} // namespace

/// PNG files of others: the file's size bounds the memory they take.
class tst_readPicture : public QObject
{
    Q_OBJECT

private slots:
    void keepsPixelsAndProvenance()
    {
        // Short texts are stored as they are, long ones compressed, those beyond Latin-1 in UTF-8.
        for (const QString &text :
             {QStringLiteral("{}"), QString(100'000, QLatin1Char('a')), QStringLiteral("\"½ \U0001F3B5 漢\"")}) {
            const QImage picture = smallPicture(text);
            const QImage read = readPicture(written(bytesOf(picture)));
            QCOMPARE(read.text(pictureProvenanceKey()), text);
            QCOMPARE(read.convertToFormat(picture.format()), picture);
        }
    }

    void refusesAChunkBeyondTheFile()
    {
        QByteArray bytes = bytesOf(smallPicture(QStringLiteral("{}")));
        const qsizetype text = bytes.indexOf("tEXt");
        QVERIFY(text > 0);
        bytes[text - 4] = 0x60; // 1.6 GB of text
        const long before = mostMemory();
        QVERIFY_THROWS_EXCEPTION(Error, readPicture(written(bytes)));
        QVERIFY2(mostMemory() - before < 50'000, "a small file took more than 50 MB");
    }

    void expandsNoForeignText()
    {
        // A text of five million letters, compressed to some kilobytes, a hundred times over.
        QImage large = smallPicture(QStringLiteral("{}"));
        large.setText(QStringLiteral("another"), QString(5'000'000, QLatin1Char('a')));
        QByteArray bytes = bytesOf(large);
        const qsizetype length = bytes.indexOf("zTXt") - 4;
        QVERIFY(length > 0);
        const QByteArray chunk = bytes.mid(length, qFromBigEndian<quint32>(bytes.constData() + length) + 12);
        for (int i = 0; i < 100; ++i)
            bytes.insert(length, chunk);
        const long before = mostMemory();
        const QImage read = readPicture(written(bytes));
        QCOMPARE(read.text(pictureProvenanceKey()), QStringLiteral("{}"));
        QVERIFY2(mostMemory() - before < 100'000, "foreign texts were expanded");
    }

private:
    QString written(const QByteArray &bytes)
    {
        QFile file(m_folder.filePath(QStringLiteral("picture.png")));
        return file.open(QIODevice::WriteOnly) && file.write(bytes) == bytes.size() ? file.fileName() : QString();
    }

    QByteArray bytesOf(const QImage &picture)
    {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        picture.save(&buffer, "PNG");
        return bytes;
    }

    QTemporaryDir m_folder;
};

FAINTLINE_WINDOW_TEST(tst_readPicture)
#include "tst_readPicture.moc"
