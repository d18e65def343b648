#include "widgets/plot/CurveKey.h"

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

CurveKey::CurveKey(Qt::Alignment corner) : m_corner(corner)
{
    setZ(50.0);
}

void CurveKey::follow(const Theme::Colours &colours, int opacity)
{
    textColour = colours.text;
    plate = colours.canvas;
    plate.setAlpha(opacity);
}

double CurveKey::height() const
{
    return entries.empty() ? 0.0 : std::ceil(QFontMetricsF(Theme::plotFont()).height()) * double(entries.size()) + 8.0;
}

void CurveKey::draw(QPainter *painter, const QwtScaleMap &, const QwtScaleMap &, const QRectF &canvasRect) const
{
    if (entries.empty())
        return;
    constexpr double sample = 16.0, gap = 5.0, margin = 5.0;
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setFont(Theme::plotFont());
    const QFontMetricsF metrics(painter->font());
    double widest = 0.0;
    for (const Entry &entry : entries)
        widest = std::max(widest, metrics.horizontalAdvance(entry.name));
    const double line = std::ceil(metrics.height());
    const QSizeF size(std::ceil(widest) + sample + gap + 2 * margin, line * double(entries.size()) + 4.0);
    if (size.width() > 0.75 * canvasRect.width() || size.height() > 0.5 * canvasRect.height()) { // curves come first
        painter->restore();
        return;
    }
    const double x =
        m_corner.testFlag(Qt::AlignRight) ? canvasRect.right() - size.width() - 4.0 : canvasRect.left() + 4.0;
    const double y =
        m_corner.testFlag(Qt::AlignBottom) ? canvasRect.bottom() - size.height() - 4.0 : canvasRect.top() + 4.0;
    painter->setPen(Qt::NoPen);
    painter->setBrush(plate);
    painter->drawRoundedRect(QRectF(QPointF(x, y), size), 3.0, 3.0);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const double middle = y + 2.0 + line * (double(i) + 0.5);
        const QRectF piece(x + margin, middle - 4.0, sample, 8.0);
        if (entries[i].isArea) {
            painter->fillRect(piece, entries[i].pen.color());
        } else {
            painter->setPen(entries[i].pen);
            painter->drawLine(QPointF(piece.left(), middle), QPointF(piece.right(), middle));
        }
        painter->setPen(textColour);
        painter->drawText(QRectF(piece.right() + gap, middle - line / 2.0, widest + 2.0, line),
                          Qt::AlignLeft | Qt::AlignVCenter, entries[i].name);
    }
    painter->restore();
}

} // namespace faintline
