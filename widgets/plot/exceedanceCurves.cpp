#include "widgets/plot/exceedanceCurves.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

namespace {

    constexpr double lowestNats = -4.0; ///< of the recording's histogram

    /// Whether enough cells were counted; below that the calibration uses the fitted tail instead of the simulated
    /// curve.
    bool isCountedWell(const Calibration &calibration, std::size_t level)
    {
        const double simulated = calibration.exceedance(level);
        return simulated > 0.0 && std::abs(calibration.exceedanceAt(calibration.level(level)) / simulated - 1.0) < 1e-6;
    }

} // namespace

double log10OrFloor(double value)
{
    return value > 0.0 ? std::max(std::log10(value), smallestExponent - 6.0) : smallestExponent - 6.0;
}

QPolygonF logarithmic(const QPolygonF &points)
{
    QPolygonF result;
    for (const QPointF &point : points)
        result << QPointF(point.x(), log10OrFloor(point.y()));
    return result;
}

QPolygonF simulatedCurve(const Calibration &calibration)
{
    QPolygonF simulated;
    for (std::size_t i = 0; i < calibration.levelCount(); ++i)
        if (isCountedWell(calibration, i))
            simulated << QPointF(calibration.level(i), std::log10(calibration.exceedance(i)));
    return simulated;
}

QPolygonF recordedCurve(const std::vector<double> &counts)
{
    QPolygonF measured;
    const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
    double above = total;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (above > 0.0)
            measured << QPointF(lowestNats + countedNats * double(i), std::log10(above / total));
        above -= counts[i];
    }
    return measured;
}

QList<QwtIntervalSample> recordedCells(const std::vector<double> &counts, double highest)
{
    QList<QwtIntervalSample> bars;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double nats = lowestNats + countedNats * double(i);
        if (counts[i] > 0.0 && nats < highest)
            bars << QwtIntervalSample(std::log10(counts[i]), nats, nats + countedNats);
    }
    return bars;
}

Span exceedanceSpan(const Calibration *calibration, const std::vector<double> &counts, double threshold)
{
    double low = 0.0, high = 30.0;
    if (calibration && calibration->levelCount() > 0) {
        low = std::max(calibration->level(0), -2.0);
        std::size_t last = calibration->levelCount() - 1;
        while (last > 0 && calibration->exceedance(last) <= 0.0)
            --last;
        high = std::max({calibration->level(last), calibration->anchorNats, low + 5.0});
        high += 8.0 / std::max(calibration->tailSlope, 0.05);
        // Signals lie beyond: the threshold can be dragged to faint ones, while the noise curve keeps half of the
        // width.
        const auto highest = std::find_if(counts.rbegin(), counts.rend(), [](double count) { return count > 0.0; });
        const double recorded = lowestNats + countedNats * double(counts.rend() - highest);
        high = std::clamp(recorded, high, low + 2.0 * (high - low));
    }
    // Room beyond the threshold, in steps, so that the scale does not follow each small change.
    while (threshold > low + 0.85 * (high - low))
        high = low + 1.25 * (high - low);
    return {std::min(low, threshold - 1.0), high};
}

} // namespace faintline
