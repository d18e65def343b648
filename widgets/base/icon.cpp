#include "widgets/base/icon.h"

#include <QFile>
#include <QGuiApplication>
#include <QIconEngine>
#include <QPainter>
#include <QPalette>
#include <QPixmap>
#include <QSvgRenderer>

namespace faintline {

namespace {

    /// Draws a one-colour SVG in the current colour of the palette.
    class PaletteIconEngine : public QIconEngine
    {
    public:
        explicit PaletteIconEngine(QByteArray svg) : m_svg(std::move(svg)) {}

        void paint(QPainter *painter, const QRect &rect, QIcon::Mode mode, QIcon::State) override
        {
            const auto group = mode == QIcon::Disabled ? QPalette::Disabled : QPalette::Active;
            const auto role = mode == QIcon::Selected ? QPalette::HighlightedText : QPalette::ButtonText;
            const QColor colour = QGuiApplication::palette().color(group, role);
            QSvgRenderer renderer(QByteArray(m_svg).replace("#000", colour.name().toLatin1()));
            painter->setRenderHint(QPainter::Antialiasing);
            renderer.render(painter, rect);
        }

        QPixmap pixmap(const QSize &size, QIcon::Mode mode, QIcon::State state) override
        {
            QPixmap result(size);
            result.fill(Qt::transparent);
            QPainter painter(&result);
            paint(&painter, QRect(QPoint(), size), mode, state);
            return result;
        }

        QIconEngine *clone() const override { return new PaletteIconEngine(m_svg); }

    private:
        QByteArray m_svg;
    };

    QByteArray read(const QString &name)
    {
        QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
        return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
    }

} // namespace

QIcon icon(const QString &name)
{
    const QByteArray svg = read(name);
    return svg.isEmpty() ? QIcon() : QIcon(new PaletteIconEngine(svg));
}

QIcon programIcon()
{
    QSvgRenderer renderer(read(QStringLiteral("faintline")));
    QIcon result;
    for (const int size : {16, 24, 32, 48, 64, 128, 256}) {
        QPixmap pixmap(size, size);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        renderer.render(&painter, QRectF(0, 0, size, size));
        painter.end();
        result.addPixmap(pixmap);
    }
    return result;
}

} // namespace faintline
