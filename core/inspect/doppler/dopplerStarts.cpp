#include "inspect/doppler/dopplerStarts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace faintline {

namespace {

    constexpr std::size_t mostPoints = 60;
    constexpr double speedFactors[]{1.0, 1.3, 1.8, 3.0, 6.0, 15.0};
    constexpr double timeFactors[]{0.003, 0.01, 0.03, 0.1, 0.25, 0.6, 1.5, 4.0, 10.0}; ///< R/v in track lengths
    constexpr double heardStep = 0.125; ///< in track lengths, from one before its middle to one after
    constexpr double mostBeta = 0.95;

    std::vector<DopplerPoint> evenly(const std::vector<DopplerPoint> &points)
    {
        const std::size_t count = std::min(points.size(), mostPoints);
        std::vector<DopplerPoint> some;
        for (std::size_t i = 0; i < count; ++i)
            some.push_back(points[i * (points.size() - 1) / (count - 1)]);
        return some;
    }

    /// The smallest v/c whose pass spans the points.
    double leastBeta(const std::vector<DopplerPoint> &points)
    {
        std::vector<double> hz;
        for (const DopplerPoint &point : points)
            hz.push_back(point.hz);
        std::sort(hz.begin(), hz.end());
        const double low = hz[hz.size() / 20];
        const double high = hz[hz.size() - 1 - hz.size() / 20];
        const double errors = 0.1 * points.front().deviationHz / high;
        return std::clamp((high - low) / (high + low), std::max(errors, 1e-14), mostBeta);
    }

    double medianOfStarts(std::vector<double> &values)
    {
        const auto middle = values.begin() + std::ssize(values) / 2;
        std::nth_element(values.begin(), middle, values.end());
        return *middle;
    }

    void setMedianRest(DopplerPass &pass, const std::vector<DopplerPoint> &points, double propagation)
    {
        pass.restHz = 1.0;
        std::vector<double> ratios;
        for (const DopplerPoint &point : points)
            ratios.push_back(point.hz / receivedHz(pass, propagation, point.seconds));
        pass.restHz = medianOfStarts(ratios);
    }

    /// When the closest approach is heard, relative to the points.
    enum class When { Any, Before, After };

    bool isHeard(When when, const DopplerPass &pass, const std::vector<DopplerPoint> &points, double propagation)
    {
        const double heard = pass.closestSeconds + pass.rangeMetres / propagation;
        return when == When::Any || (when == When::Before && heard < points.front().seconds)
               || (when == When::After && heard > points.back().seconds);
    }

} // namespace

double absoluteMisfit(const std::vector<DopplerPoint> &points, double propagation, const DopplerPass &pass)
{
    double sum = 0.0;
    for (const DopplerPoint &point : points)
        sum += std::abs(point.hz - receivedHz(pass, propagation, point.seconds)) / point.deviationHz;
    return sum;
}

std::vector<DopplerPass> passesElsewhere(const std::vector<DopplerPoint> &points, double propagation)
{
    const std::vector<DopplerPoint> some = evenly(points);
    const double length = some.back().seconds - some.front().seconds;
    const double middle = 0.5 * (some.back().seconds + some.front().seconds);
    std::vector<DopplerPass> passes;
    for (const double beta : {0.003, 0.03, 0.1, 0.3, 0.9})
        for (const double heard : {-3.0, 3.0}) {
            DopplerPass pass;
            pass.metresPerSecond = beta * propagation;
            pass.rangeMetres = 0.1 * pass.metresPerSecond * length;
            pass.closestSeconds = middle + heard * length - pass.rangeMetres / propagation;
            setMedianRest(pass, some, propagation);
            passes.push_back(pass);
        }
    return passes;
}

std::vector<DopplerPass> dopplerStarts(const std::vector<DopplerPoint> &points, double propagation, std::size_t most)
{
    const std::vector<DopplerPoint> some = evenly(points);
    const double length = some.back().seconds - some.front().seconds;
    const double middle = 0.5 * (some.back().seconds + some.front().seconds);
    const double least = leastBeta(some);
    std::vector<std::pair<double, DopplerPass>> ranked;
    for (const double speedFactor : speedFactors)
        for (const double timeFactor : timeFactors)
            for (double heard = -1.0; heard <= 1.0; heard += heardStep) {
                DopplerPass pass;
                pass.metresPerSecond = propagation * std::min(least * speedFactor, mostBeta);
                pass.rangeMetres = pass.metresPerSecond * timeFactor * length;
                pass.closestSeconds = middle + heard * length - pass.rangeMetres / propagation;
                setMedianRest(pass, some, propagation);
                ranked.emplace_back(absoluteMisfit(some, propagation, pass), pass);
            }
    std::sort(ranked.begin(), ranked.end(), [](const auto &a, const auto &b) { return a.first < b.first; });
    std::vector<DopplerPass> best;
    for (const When when : {When::Any, When::Before, When::After})
        for (const auto &[misfit, pass] : ranked)
            if (isHeard(when, pass, some, propagation)) {
                best.push_back(pass);
                break;
            }
    for (std::size_t i = 1; i < std::min(most, ranked.size()); ++i)
        best.push_back(ranked[i].second);
    return best;
}

} // namespace faintline
