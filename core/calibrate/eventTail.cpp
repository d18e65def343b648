#include "calibrate/eventTail.h"

#include "base/Error.h"

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace faintline {

namespace {

    constexpr std::size_t tailMinimumMaxima = 40;
    /// Block maxima above the thresholds at which events are counted, per cell and frame; after clustering and
    /// inhibition a quarter of them are events. A tail from splitting is counted where events crowd each other out, in
    /// a tenth of the noise, and where they do not (800 and 400 events in the usual 8·10⁷ cells × frames). One that is
    /// extrapolated along a line is counted at two thresholds far apart.
    constexpr std::array<double, 2> ratesBeforeSplitting{1e-3, 2e-5};
    /// At the end of a block of some hundred frames; a rate of 1e-3 a frame would be a tenth of all cells.
    constexpr std::array<double, 2> ratesOfBlocks{1e-4, 2e-5};
    constexpr std::array<double, 2> ratesOfLine{2e-5, 2.5e-6};
    /// Expected number of maxima at 2·10⁻⁵, a third of which become events of lines; in small volumes the rates are
    /// higher.
    constexpr double tailMinimumExpected = 300.0;
    constexpr double tailMinimumEvents = 20.0;

} // namespace

std::vector<double> thresholdsForEvents(std::vector<float> maxima, double cellFramesPerBlock, double cellFrames,
                                        TailShape shape)
{
    // A detector that decides in its own blocks leaves some of ours without a decision.
    const auto blocks = double(maxima.size());
    std::erase_if(maxima, [](float maximum) { return !std::isfinite(maximum); });
    if (maxima.size() < tailMinimumMaxima)
        throw Error("detector", "decides too rarely to be calibrated on noise; choose a shorter window");
    std::sort(maxima.begin(), maxima.end());
    const double perMaximum = cellFramesPerBlock * blocks / double(maxima.size());
    constexpr double lower = 0.5;
    constexpr double upper = 0.95;
    const auto quantile = [&](double p) { return double(maxima[std::size_t(p * double(maxima.size()))]); };
    const double theta =
        std::log(std::log(lower) / std::log(upper)) / std::max(1e-6, quantile(upper) - quantile(lower));
    std::vector<double> thresholds;
    const bool isLine = shape == TailShape::Line;
    const double expected = isLine ? tailMinimumExpected / 3.0 : tailMinimumExpected;
    const double scale = std::max(1.0, expected / (ratesOfLine.front() * cellFrames));
    for (const double rate : isLine ? ratesOfLine : shape == TailShape::Blocks ? ratesOfBlocks : ratesBeforeSplitting)
        thresholds.push_back(quantile(upper) + std::log(-std::log(upper) / perMaximum / (rate * scale)) / theta);
    return thresholds;
}

void fitEventRate(std::span<const double> thresholds, std::span<const double> events, double cellFrames,
                  Calibration &result)
{
    const double total = std::accumulate(events.begin(), events.end(), 0.0);
    if (total < tailMinimumEvents)
        throw Error("detector", "exceeds thresholds on noise too rarely to be calibrated");
    double anchor = 0.0; // where both parameters' errors are independent
    for (std::size_t i = 0; i < thresholds.size(); ++i)
        anchor += thresholds[i] * events[i] / total;
    const auto weights = [&](double theta) {
        std::vector<double> w;
        for (const double threshold : thresholds)
            w.push_back(std::exp(-theta * (threshold - anchor)));
        return w;
    };
    // With the rate at its best for each θ, the likelihood is that of a multinomial: Σ nᵢ ln(wᵢ/Σw), Σ nᵢ(Tᵢ - anchor)
    // = 0.
    const auto minusLogLikelihood = [&](double theta) {
        const std::vector<double> w = weights(theta);
        return total * std::log(std::accumulate(w.begin(), w.end(), 0.0));
    };
    const double range = *std::max_element(thresholds.begin(), thresholds.end())
                         - *std::min_element(thresholds.begin(), thresholds.end());
    const double theta = boost::math::tools::brent_find_minima(minusLogLikelihood, 0.0, 40.0 / range, 40).first;
    const std::vector<double> w = weights(theta);
    const double sum = std::accumulate(w.begin(), w.end(), 0.0);
    double variance = 0.0;
    for (std::size_t i = 0; i < thresholds.size(); ++i)
        variance += w[i] / sum * (thresholds[i] - anchor) * (thresholds[i] - anchor);
    result.anchorNats = anchor;
    result.tailSlope = theta;
    result.slopeError = 1.0 / std::sqrt(total * variance);
    result.relativeError = 1.0 / std::sqrt(total);
    result.eventRate = total / sum / cellFrames;
}

void anchorTail(const RareRates &rare, std::span<const double> thresholds, const EventCounts &counts,
                Calibration &result)
{
    std::vector<double> levels; // with enough events, ascending
    std::vector<double> offsets;
    double events = 0.0;
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
        if (counts.events[i] < tailMinimumEvents)
            continue;
        events = counts.events[i];
        levels.push_back(thresholds[i]);
        offsets.push_back(std::log(events / counts.cellFrames[i]) - rare.lnRateAt(thresholds[i]));
    }
    if (levels.empty())
        throw Error("detector", "exceeds thresholds on noise too rarely to be calibrated");
    const auto offset = [&](double level) {
        if (levels.size() == 1)
            return offsets.front();
        const double fraction = std::clamp((level - levels.front()) / (levels.back() - levels.front()), 0.0, 1.0);
        return offsets.front() + fraction * (offsets.back() - offsets.front());
    };
    const double anchor = levels.back();
    const double own = 1.0 / std::sqrt(events);
    const double known = rare.relativeErrorAt(anchor);
    std::vector<double> knots = rare.levels;
    knots.insert(knots.end(), levels.begin(), levels.end());
    std::sort(knots.begin(), knots.end());
    knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
    for (const double level : knots) {
        const double error = rare.relativeErrorAt(level);
        result.rates.levels.push_back(level);
        result.rates.lnRates.push_back(rare.lnRateAt(level) + offset(level));
        result.rates.relativeErrors.push_back(std::hypot(own, std::sqrt(std::max(0.0, error * error - known * known))));
    }
    const RareRates &rates = result.rates;
    const std::size_t before = knots.size() - std::min<std::size_t>(4, knots.size());
    result.anchorNats = anchor;
    result.eventRate = std::exp(rates.lnRateAt(anchor));
    result.relativeError = own;
    result.tailSlope = (rates.lnRates[before] - rates.lnRates.back()) / (knots.back() - knots[before]);
    result.slopeError = rates.relativeErrors.back() / std::max(1.0, knots.back() - anchor);
}

} // namespace faintline
