#include "widgets/steadyAxes.h"

#include "widgets/Theme.h"

#include <qwt_plot.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_widget.h>

#include <QFontMetrics>

namespace faintline {

void steadyAxes(QwtPlot &plot, const QString &left, const QString &bottom)
{
    const QFontMetrics metrics(Theme::plotFont());
    const int halfWidth = metrics.horizontalAdvance(bottom) / 2 + 2, halfHeight = metrics.height() / 2 + 1;
    plot.axisWidget(QwtAxis::XBottom)->setMinBorderDist(halfWidth, halfWidth);
    for (const QwtAxisId axis : {QwtAxis::YLeft, QwtAxis::YRight}) {
        QwtScaleDraw &draw = *plot.axisScaleDraw(axis);
        draw.setMinimumExtent(metrics.horizontalAdvance(left) + draw.spacing() + draw.maxTickLength());
        plot.axisWidget(axis)->setMinBorderDist(halfHeight, halfHeight);
        plot.axisWidget(axis)->setLabelRotation(draw.labelRotation()); // has it measure the scale anew
    }
}

} // namespace faintline
