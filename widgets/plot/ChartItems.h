#pragma once

#include "evaluate/experiments/Chart.h"
#include "widgets/base/Theme.h"

#include <QPixmap>
#include <QPointF>

#include <memory>
#include <optional>
#include <vector>

class QwtPlotCurve;
class QwtPlotItem;
class QwtPlotMarker;

namespace faintline {

/// The curves of a core `Chart` as items of a plot: measured curves with their intervals as bars, or as a band where
/// points stand close; theory dashed; publications' points hollow.
///
/// A theory curve or a publication's points take the colour of the measured curve whose name theirs begins with.
/// Refers to the chart and the colours.
class ChartItems
{
public:
    ChartItems(const Chart &chart, const Theme::Colours &colours) : m_chart(chart), m_colours(colours) {}

    bool isMeasured(std::size_t curve) const { return m_chart.curves[curve].kind == Curve::Kind::Measured; }
    /// Coordinates on the axes, which count decades where they are logarithmic.
    double abscissa(double x) const;
    double ordinate(double y) const;
    QPointF place(const Curve::Point &point) const { return {abscissa(point.x), ordinate(point.y)}; }

    std::unique_ptr<QwtPlotCurve> curve(std::size_t index) const;
    /// Null where no point has an interval.
    std::unique_ptr<QwtPlotItem> intervals(std::size_t index) const;
    /// Of the points that have one.
    std::vector<std::unique_ptr<QwtPlotMarker>> labels(std::size_t index) const;
    /// A piece of the curve for the key.
    QPixmap sample(std::size_t index, double devicePixelRatio) const;

private:
    std::optional<std::size_t> styleOf(std::size_t curve) const;
    std::size_t symbolStyleOf(std::size_t curve) const;
    QColor colourOf(std::size_t curve) const;

    const Chart &m_chart;
    const Theme::Colours &m_colours;
};

} // namespace faintline
