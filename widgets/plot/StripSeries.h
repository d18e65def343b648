#pragma once

#include "base/Axis.h"
#include "widgets/base/Span.h"

#include <qwt_axis_id.h>

#include <QPolygonF>
#include <QString>

#include <limits>
#include <vector>

class QwtPlotCurve;

namespace faintline {

/// One curve of a StripPlot and its data.
struct StripSeries {
    QString name;
    Axis time;
    std::vector<float> values;
    QwtAxisId side = 0; ///< its ordinate
    QwtPlotCurve *curve = nullptr;
    Span seen{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()}; ///< visible values

    /// The visible part: every value if there is room, otherwise minimum and maximum of each pixel.
    QPolygonF points(const Span &span, int pixels);

private:
    void appendExtremes(Index begin, Index end, QPolygonF &polygon);
};

} // namespace faintline
