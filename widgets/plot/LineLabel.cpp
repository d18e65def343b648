#include "widgets/plot/LineLabel.h"

#include "widgets/base/Theme.h"

#include <qwt_scale_map.h>

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>

namespace faintline {

LineLabel::LineLabel()
{
    setZ(60.0);
}

void LineLabel::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &, const QRectF &canvasRect) const
{
    constexpr double gap = 6.0;
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setFont(Theme::boldFont(12));
    const QSizeF size = QFontMetricsF(painter->font()).size(0, text) + QSizeF(10.0, 5.0);
    const double line = xMap.transform(x);
    const bool isLeft = line - canvasRect.left() > canvasRect.right() - line;
    QRectF box(QPointF(isLeft ? line - gap - size.width() : line + gap, canvasRect.bottom() - gap - size.height()),
               size);
    box.moveLeft(std::clamp(box.left(), canvasRect.left() + 1.0,
                            std::max(canvasRect.right() - size.width() - 1.0, canvasRect.left() + 1.0)));
    painter->setPen(Qt::NoPen);
    painter->setBrush(plate);
    painter->drawRoundedRect(box, 3.0, 3.0);
    painter->setPen(colour);
    painter->drawText(box, Qt::AlignCenter, text);
    painter->restore();
}

} // namespace faintline
