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

/// The curves of a core `Chart` as plot items: measured curves with their intervals as bars, or as a band for dense
/// points; theory dashed; published points hollow.
///
/// A theory curve or published points get the colour of the measured curve with whose name theirs begins. Holds
/// references to the chart and the colours.
class ChartItems
{
public:
    ChartItems(const Chart &chart, const Theme::Colours &colours) : m_chart(chart), m_colours(colours) {}

    bool isMeasured(std::size_t curve) const { return m_chart.curves[curve].kind == Curve::Kind::Measured; }
    /// Axis coordinates; logarithmic axes count decades.
    double abscissa(double x) const;
    double ordinate(double y) const;
    QPointF place(const Curve::Point &point) const { return {abscissa(point.x), ordinate(point.y)}; }

    std::unique_ptr<QwtPlotCurve> curve(std::size_t index) const;
    /// Null if no point has an interval.
    std::unique_ptr<QwtPlotItem> intervals(std::size_t index) const;
    /// For the points that have one.
    std::vector<std::unique_ptr<QwtPlotMarker>> labels(std::size_t index) const;
    /// A sample of the curve for the key.
    QPixmap sample(std::size_t index, double devicePixelRatio) const;

private:
    std::optional<std::size_t> styleOf(std::size_t curve) const;
    std::size_t symbolStyleOf(std::size_t curve) const;
    QColor colourOf(std::size_t curve) const;

    const Chart &m_chart;
    const Theme::Colours &m_colours;
};

} // namespace faintline
