#include "reproduce/grossiParts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace faintline {

std::string deviationName(double deviation)
{
    return std::isinf(deviation) ? "uniform" : "σ = " + formatNumber(deviation);
}

std::string inFormat(const char *format, double value)
{
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, format, value);
    return buffer;
}

double toleranceOf(double referenceError, double ourError, double rounding)
{
    return 4.0 * std::hypot(referenceError, ourError) + 0.5 * rounding;
}

double frequencyError(double p, double trials)
{
    const double inside = std::clamp(p, 1.0 / trials, 1.0 - 1.0 / trials);
    return std::sqrt(inside * (1.0 - inside) / trials);
}

ReproducedCell measuredCell(std::string row, std::string column, const Estimate &ours, const Published &reference)
{
    ReproducedCell cell;
    cell.row = std::move(row);
    cell.column = std::move(column);
    cell.reference = reference.value;
    cell.ours = ours.value;
    cell.interval = ours.interval();
    cell.tolerance = toleranceOf(reference.error, ours.standardError, reference.rounding);
    return cell;
}

ReproducedCell exactCell(std::string row, std::string column, double ours, double reference, double tolerance)
{
    ReproducedCell cell;
    cell.row = std::move(row);
    cell.column = std::move(column);
    cell.reference = reference;
    cell.ours = ours;
    cell.tolerance = tolerance;
    return cell;
}

ReproducedCell frequencyCell(std::string row, std::string column, const TrialCount &ours,
                             const PublishedFrequency &reference)
{
    const auto n = double(ours.trials);
    const double p = double(ours.successes) / n;
    ReproducedCell cell;
    cell.row = std::move(row);
    cell.column = std::move(column);
    cell.reference = reference.value;
    cell.ours = p;
    cell.interval = wilsonInterval(ours.successes, ours.trials);
    cell.tolerance =
        toleranceOf(frequencyError(reference.value, reference.trials), frequencyError(p, n), reference.rounding);
    return cell;
}

Index reducedTrials(Index full, const ReproduceOptions &options)
{
    return options.quick ? full / 10 : full;
}

} // namespace faintline
