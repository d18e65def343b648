#include "widgets/base/CanvasSentence.h"

#include "widgets/base/Theme.h"

#include <QPainter>

#include <algorithm>

namespace faintline {

CanvasSentence::CanvasSentence()
{
    setZ(70.0);
}

void CanvasSentence::draw(QPainter *painter, const QwtScaleMap &, const QwtScaleMap &, const QRectF &canvasRect) const
{
    const double margin = std::min(40.0, 0.08 * canvasRect.width());
    painter->save();
    painter->setFont(Theme::font(pixelSize));
    painter->setPen(colour);
    painter->drawText(canvasRect.adjusted(margin, 0.0, -margin, 0.0), Qt::AlignCenter | Qt::TextWordWrap, text);
    painter->restore();
}

} // namespace faintline
