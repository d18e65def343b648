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
        plot.axisWidget(axis)->setLabelRotation(draw.labelRotation()); // recomputes the scale's layout
    }
    if (!hasChanged)
        return;
    // Titles are placed beside the numbers: the widgets must repeat their layout, which they do automatically only if
    // the ticks change.
    for (const QwtAxisId axis : {QwtAxis::YLeft, QwtAxis::YRight, QwtAxis::XBottom})
        plot.axisWidget(axis)->setLabelRotation(plot.axisScaleDraw(axis)->labelRotation());
    plot.updateLayout();
}

} // namespace faintline
