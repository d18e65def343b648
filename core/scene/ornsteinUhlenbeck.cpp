#include "scene/ornsteinUhlenbeck.h"

#include <algorithm>
#include <cmath>

namespace faintline {

std::vector<double> ornsteinUhlenbeck(Random &random, Index count, double step)
{
    const double kept = std::exp(-step);
    const double added = std::sqrt(-std::expm1(-2.0 * step));
    std::vector<double> path(static_cast<std::size_t>(count));
    double x = random.normal();
    for (double &value : path) {
        value = x;
        x = kept * x + added * random.normal();
    }
    return path;
}

void standardise(std::vector<double> &path, double deviation)
{
    const double n = double(path.size());
    double sum = 0.0;
    for (const double value : path)
        sum += value;
    const double mean = sum / n;
    double squares = 0.0;
    for (const double value : path)
        squares += (value - mean) * (value - mean);
    const double factor = squares > 0.0 ? deviation / std::sqrt(squares / n) : 0.0;
    for (double &value : path)
        value = (value - mean) * factor;
}

double interpolate(const std::vector<double> &path, double position)
{
    const double inside = std::clamp(position, 0.0, double(path.size() - 1));
    const auto index = std::size_t(inside);
    return index + 1 < path.size() ? path[index] + (path[index + 1] - path[index]) * (inside - std::floor(inside))
                                   : path.back();
}

} // namespace faintline
