#include "app/document/saveView.h"

#include "app/base/filePath.h"
#include "app/document/Provenance.h"
#include "base/files/AtomicFile.h"
#include "base/files/fileName.h"

#include <QBuffer>
#include <QCoreApplication>
#include <QFileInfo>
#include <QPainter>
#include <QPdfWriter>
#include <QPixmap>
#include <QSvgGenerator>
#include <QWidget>

namespace faintline {

namespace {

    QByteArray png(QWidget &view, const std::string &provenance)
    {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        QImage image = view.grab().toImage();
        if (!provenance.empty())
            image.setText(pictureProvenanceKey(), pictureProvenance(provenance));
        image.save(&buffer, "PNG");
        return bytes;
    }

    QByteArray svg(QWidget &view, const QString &provenance)
    {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        QSvgGenerator generator;
        generator.setOutputDevice(&buffer);
        generator.setSize(view.size());
        generator.setViewBox(view.rect());
        generator.setTitle(view.accessibleName().toHtmlEscaped()); // the generator does not escape it
        generator.setDescription(provenance.toHtmlEscaped());
        generator.setResolution(96); // a pixel stays a pixel
        QPainter painter(&generator);
        view.render(&painter);
        painter.end();
        return bytes;
    }

    QByteArray pdf(QWidget &view, const QString &provenance)
    {
        constexpr int dotsPerInch = 96;
        QByteArray bytes;
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        QPdfWriter writer(&buffer);
        writer.setResolution(dotsPerInch);
        writer.setPageSize(QPageSize(QSizeF(view.size()) / dotsPerInch, QPageSize::Inch));
        writer.setPageMargins({});
        writer.setTitle(view.accessibleName());
        if (!provenance.isEmpty())
            writer.addFileAttachment(QStringLiteral("provenance.json"), provenance.toUtf8(),
                                     QStringLiteral("application/json"));
        QPainter painter(&writer);
        view.render(&painter);
        painter.end();
        return bytes;
    }

} // namespace

void saveView(QWidget &view, const std::string &csv, const QString &path, const std::string &provenance)
{
    checkEnding(pathBytes(path), {".png", ".svg", ".pdf", ".csv"});
    const QString origin = QString::fromStdString(provenance);
    const QString extension = QFileInfo(path).suffix().toLower();
    QByteArray bytes;
    if (extension == QLatin1String("png"))
        bytes = png(view, provenance);
    else if (extension == QLatin1String("svg"))
        bytes = svg(view, origin);
    else if (extension == QLatin1String("pdf"))
        bytes = pdf(view, origin);
    else
        bytes = QByteArray::fromStdString(csv);
    writeTextFile(pathBytes(path), bytes.toStdString());
    if (extension == QLatin1String("csv") && !provenance.empty())
        writeProvenanceBeside(path, provenance);
}

QString saveViewFilter()
{
    return QCoreApplication::translate("saveView",
                                       "Picture (*.png);;Drawing (*.svg);;Document (*.pdf);;Numbers (*.csv)");
}

} // namespace faintline
