#include "widgets/plot/ChartMarks.h"

#include "widgets/base/Theme.h"

#include <qwt_scale_map.h>

#include <QFontMetricsF>
#include <QPainter>

#include <cmath>

namespace faintline {

ChartMarks::ChartMarks()
{
    setZ(15.0); // below the curves to which they point
}

void ChartMarks::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &, const QRectF &canvasRect) const
{
    constexpr double top = 2.0, between = 3.0;
    painter->save();
    painter->setFont(Theme::plotFont());
    const QFontMetricsF metrics(painter->font());
    double free = canvasRect.left();
    for (const ChartMark &mark : marks) {
        const double x = std::round(xMap.transform(mark.x)) + 0.5;
        if (x < canvasRect.left() || x > canvasRect.right())
            continue;
        painter->setPen(QPen(colour, 1.0, Qt::DotLine));
        painter->drawLine(QPointF(x, canvasRect.top()), QPointF(x, canvasRect.bottom()));
        const double width = std::ceil(metrics.horizontalAdvance(mark.name)) + 2.0;
        const QRectF name(x - 0.5 * width, canvasRect.top() + top, width, std::ceil(metrics.height()));
        if (name.left() < free || name.right() > canvasRect.right())
            continue;
        painter->fillRect(name, plate);
        painter->setPen(colour);
        painter->drawText(name, Qt::AlignCenter, mark.name);
        free = name.right() + between;
    }
    painter->restore();
}

} // namespace faintline
