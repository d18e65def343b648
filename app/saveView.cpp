#include "app/saveView.h"

#include "base/AtomicFile.h"
#include "base/Error.h"

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

    QByteArray png(QWidget &view)
    {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        buffer.open(QIODevice::WriteOnly);
        view.grab().toImage().save(&buffer, "PNG");
        return bytes;
    }

    QByteArray svg(QWidget &view)
    {
        QByteArray bytes;
        QBuffer buffer(&bytes);
        QSvgGenerator generator;
        generator.setOutputDevice(&buffer);
        generator.setSize(view.size());
        generator.setViewBox(view.rect());
        generator.setTitle(view.accessibleName());
        generator.setResolution(96); // a pixel stays a pixel
        QPainter painter(&generator);
        view.render(&painter);
        painter.end();
        return bytes;
    }

    QByteArray pdf(QWidget &view)
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
        QPainter painter(&writer);
        view.render(&painter);
        painter.end();
        return bytes;
    }

} // namespace

void saveView(QWidget &view, const std::string &csv, const QString &path)
{
    const QString extension = QFileInfo(path).suffix().toLower();
    QByteArray bytes;
    if (extension == QLatin1String("png"))
        bytes = png(view);
    else if (extension == QLatin1String("svg"))
        bytes = svg(view);
    else if (extension == QLatin1String("pdf"))
        bytes = pdf(view);
    else if (extension == QLatin1String("csv"))
        bytes = QByteArray::fromStdString(csv);
    else
        throw Error(path.toStdString(), "must end in .png, .svg, .pdf or .csv");
    writeTextFile(path.toStdString(), bytes.toStdString());
}

QString saveViewFilter()
{
    return QCoreApplication::translate("saveView", "Picture (*.png);;Drawing (*.svg);;Document (*.pdf);;Numbers (*.csv)");
}

} // namespace faintline
