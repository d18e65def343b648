#include "widgets/plot/plotCsv.h"

#include "base/Field.h"

#include <qwt_plot.h>
#include <qwt_plot_curve.h>
#include <qwt_plot_histogram.h>
#include <qwt_text.h>

#include <cmath>

namespace faintline {

namespace {

    /// In quotes, because names may contain commas.
    std::string quoted(QString name)
    {
        return '"' + name.replace(QLatin1Char('"'), QStringLiteral("\"\"")).toStdString() + '"';
    }

} // namespace

std::string plotCsv(const QwtPlot &plot, bool isLogarithmicY)
{
    std::string csv = "curve,x,y\n";
    int number = 0;
    for (const QwtPlotItem *item : plot.itemList(QwtPlotItem::Rtti_PlotCurve)) {
        const auto &curve = static_cast<const QwtPlotCurve &>(*item);
        ++number;
        if (!curve.isVisible())
            continue;
        const std::string name =
            quoted(curve.title().isEmpty() ? QStringLiteral("curve %1").arg(number) : curve.title().text());
        for (std::size_t i = 0; i < curve.dataSize(); ++i) {
            const QPointF point = curve.sample(int(i));
            csv += name + "," + formatNumber(point.x()) + ","
                   + formatNumber(isLogarithmicY ? std::pow(10.0, point.y()) : point.y()) + "\n";
        }
    }
    for (const QwtPlotItem *item : plot.itemList(QwtPlotItem::Rtti_PlotHistogram)) {
        const auto &histogram = static_cast<const QwtPlotHistogram &>(*item);
        const std::string name = quoted(histogram.title().text());
        for (std::size_t i = 0; histogram.isVisible() && i < histogram.dataSize(); ++i)
            if (const QwtIntervalSample bin = histogram.sample(int(i)); bin.value > histogram.baseline())
                csv += name + "," + formatNumber(0.5 * (bin.interval.minValue() + bin.interval.maxValue())) + ","
                       + formatNumber(isLogarithmicY ? std::round(std::pow(10.0, bin.value)) : bin.value) + "\n";
    }
    return csv;
}

} // namespace faintline
