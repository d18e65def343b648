#include "widgets/base/textPlate.h"

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

QRectF movedInto(QRectF box, const QRectF &canvas)
{
    box.moveLeft(std::clamp(box.left(), canvas.left(), std::max(canvas.right() - box.width(), canvas.left())));
    box.moveTop(std::clamp(box.top(), canvas.top(), std::max(canvas.bottom() - box.height(), canvas.top())));
    return box;
}

QRectF plateOf(const QString &text, const QPointF &corner, const QRectF &canvas, const QFont &font)
{
    const QFontMetricsF metrics(font);
    const QStringList lines = text.split(QLatin1Char('\n'));
    double width = 0.0;
    for (const QString &line : lines)
        width = std::max(width, metrics.horizontalAdvance(line));
    const QSizeF size(std::ceil(width) + 8.0, double(lines.size()) * std::ceil(metrics.height()) + 1.0);
    return movedInto(QRectF(corner, size), canvas);
}

void drawOnPlate(QPainter &painter, const QRectF &plate, const QString &text, const QColor &colour,
                 const QColor &ground, Qt::Alignment alignment)
{
    painter.setPen(Qt::NoPen);
    painter.setBrush(ground);
    painter.drawRoundedRect(plate, 3.0, 3.0);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(colour);
    if (alignment != Qt::AlignLeft)
        return painter.drawText(plate, int(alignment), text);
    const double height = std::ceil(QFontMetricsF(painter.font()).height());
    QRectF line(plate.left() + 4.0, plate.top(), plate.width(), height);
    for (const QString &words : text.split(QLatin1Char('\n'))) {
        painter.drawText(line, Qt::AlignLeft | Qt::AlignVCenter, words);
        line.translate(0.0, height);
    }
}

} // namespace faintline
