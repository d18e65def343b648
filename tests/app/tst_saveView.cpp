// What a saved view tells of its making, read back from the file as another program would.

#include "app/document/saveView.h"
#include "support/files.h"
#include "support/test.h"

#include "app/document/Provenance.h"
#include "base/Error.h"
#include "base/json.h"

#include <QImageReader>
#include <QLabel>

using namespace faintline;
using namespace faintline::test;

namespace {

const std::string provenance = "{\n  \"recording\": {\"name\": \"Wal   & Möwe <1>.wav\"},\n  \"version\": \"0\"\n}\n";

/// The contents of the file attached to a PDF, inflated.
QByteArray attachmentOf(const QByteArray &pdf)
{
    const QByteArray file = "/EF <</F ";
    const qsizetype named = pdf.indexOf(file);
    if (named < 0)
        return {};
    const QByteArray number = pdf.mid(named + file.size()).split(' ').first();
    const qsizetype begin = pdf.indexOf("stream\n", pdf.indexOf("\n" + number + " 0 obj")) + 7;
    const QByteArray stream = pdf.mid(begin, pdf.indexOf("endstream", begin) - begin);
    const QByteArray mostBytes = QByteArray::fromHex("00100000");
    return qUncompress(mostBytes + stream);
}

} // namespace

class tst_saveView : public QObject
{
    Q_OBJECT

    QTemporaryDir m_folder;
    std::unique_ptr<QLabel> m_view;

    QString save(const QString &name, const std::string &origin = provenance)
    {
        const QString path = m_folder.filePath(name);
        saveView(*m_view, "a,b\n1,2\n", path, origin);
        return path;
    }

private slots:
    void initTestCase()
    {
        m_view = std::make_unique<QLabel>(QStringLiteral("a view"));
        m_view->setAccessibleName(QStringLiteral("A view"));
        m_view->resize(120, 60);
    }
    void cleanupTestCase() { m_view.reset(); }

    void pngText()
    {
        QImageReader reader(save("v.png"));
        QCOMPARE(reader.size(), QSize(120, 60));
        QVERIFY(parseJson(reader.text(pictureProvenanceKey()).toStdString(), "text")
                == parseJson(provenance, "what was given"));
        QVERIFY(QImageReader(save("plain.png", {})).text(pictureProvenanceKey()).isEmpty());
    }

    void svgDescription()
    {
        QXmlStreamReader xml(readBytes(save("v.svg")));
        QString description;
        while (!xml.atEnd())
            if (xml.readNext() == QXmlStreamReader::StartElement && xml.name() == QLatin1String("desc")
                && description.isEmpty())
                description = xml.readElementText();
        QVERIFY2(!xml.hasError(), qPrintable(xml.errorString()));
        QCOMPARE(description.trimmed(), QString::fromStdString(provenance).trimmed());
    }

    void pdfAttachment()
    {
        const QByteArray pdf = readBytes(save("v.pdf"));
        QVERIFY(pdf.startsWith("%PDF"));
        QVERIFY(pdf.contains("/Title"));
        QCOMPARE(attachmentOf(pdf).trimmed(), QByteArray::fromStdString(provenance).trimmed());
        QVERIFY(attachmentOf(readBytes(save("plain.pdf", {}))).isEmpty());
    }

    void csvHasItBeside()
    {
        QCOMPARE(readBytes(save("v.csv")), QByteArray("a,b\n1,2\n"));
        QCOMPARE(readBytes(m_folder.filePath("v.csv.provenance.json")), QByteArray::fromStdString(provenance));
        QVERIFY_EXCEPTION_THROWN(save("v.bmp"), Error);
    }
};

FAINTLINE_WINDOW_TEST(tst_saveView)
#include "tst_saveView.moc"
