#include "widgets/plot/LineLabel.h"

#include "widgets/base/textPlate.h"

#include <qwt_scale_map.h>

#include <QFontMetricsF>
#include <QPainter>

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
    const QPointF corner(isLeft ? line - gap - size.width() : line + gap, canvasRect.bottom() - gap - size.height());
    drawOnPlate(*painter, movedInto({corner, size}, canvasRect.adjusted(1.0, 0.0, -1.0, 0.0)), text, colour, plate);
    painter->restore();
}

} // namespace faintline
