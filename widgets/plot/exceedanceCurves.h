#pragma once

#include "plan/Calibration.h"
#include "widgets/base/Span.h"

#include <qwt_samples.h>

#include <QList>
#include <QPolygonF>

#include <vector>

namespace faintline {

// What ExceedancePlot draws: curves as points (T, log₁₀ of the ordinate), T the statistic in nats.
//
// `counts`: Analysis::statisticCounts, cells whose D lies in [i/4 - 4, (i+1)/4 - 4) nat.

inline constexpr double countedNats = 0.25; ///< width of a count

/// Lowest exponent of the ordinate.
inline constexpr double smallestExponent = -14.0;

/// log₁₀, but six decades below the smallest exponent for 0 and everything less than that.
double log10OrFloor(double value);

/// The same of each ordinate.
QPolygonF logarithmic(const QPolygonF &points);

/// P(D > T) of a cell on noise, at the levels where enough cells were counted; beyond, the calibration uses the fitted
/// tail instead of the simulated curve.
QPolygonF simulatedCurve(const Calibration &calibration);

/// P(D > T) of a cell of the recording, as far as any cell exceeds T.
QPolygonF recordedCurve(const std::vector<double> &counts);

/// log₁₀ of the counts that are not 0, each over its interval, as far as that begins below `highest`.
QList<QwtIntervalSample> recordedCells(const std::vector<double> &counts, double highest);

/// The abscissa: from the lowest simulated level to beyond the noise's tail, further if the recording has cells there,
/// but at most twice as wide, and always containing the threshold. `calibration`: may be null.
Span exceedanceSpan(const Calibration *calibration, const std::vector<double> &counts, double threshold);

} // namespace faintline
