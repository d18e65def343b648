#include "widgets/base/steadyAxes.h"

#include "widgets/base/Theme.h"

#include <qwt_plot.h>
#include <qwt_scale_draw.h>
#include <qwt_scale_widget.h>

#include <QFontMetrics>

namespace faintline {

void steadyAxes(QwtPlot &plot, const QString &left, const QString &bottom)
{
    const QFontMetrics metrics(Theme::plotFont());
    const int halfWidth = metrics.horizontalAdvance(bottom) / 2 + 2, halfHeight = metrics.height() / 2 + 1;
    bool hasChanged = false;
    plot.axisWidget(QwtAxis::XBottom)->setMinBorderDist(halfWidth, halfWidth);
    for (const QwtAxisId axis : {QwtAxis::YLeft, QwtAxis::YRight}) {
        QwtScaleDraw &draw = *plot.axisScaleDraw(axis);
        const double extent = metrics.horizontalAdvance(left) + draw.spacing() + draw.maxTickLength();
        hasChanged = hasChanged || extent != draw.minimumExtent();
        draw.setMinimumExtent(extent);
        plot.axisWidget(axis)->setMinBorderDist(halfHeight, halfHeight);
        plot.axisWidget(axis)->setLabelRotation(draw.labelRotation()); // has it measure the scale anew
    }
    if (!hasChanged)
        return;
    // Titles stand beside the numbers: the widgets must lay them out again, which they do by themselves only for other
    // ticks.
    for (const QwtAxisId axis : {QwtAxis::YLeft, QwtAxis::YRight, QwtAxis::XBottom})
        plot.axisWidget(axis)->setLabelRotation(plot.axisScaleDraw(axis)->labelRotation());
    plot.updateLayout();
}

} // namespace faintline
