#include "refine/explainPath.h"

#include "refine/constants.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace faintline {

namespace {

    /// Power beside the path in units of its level, the lower of both sides, decreasing outward, as far as it is
    /// significant. Nearer than `nearest` it is constant.
    std::vector<float> skirtOf(const PathStrip &strip, const ExplainedSignal &signal, Index from, Index first,
                               Index nearest = 0)
    {
        const Index end = std::min(std::ssize(signal.positions), first + ExplainedSignal::skirtFrames);
        const auto count = double(end - first);
        double level = 0.0;
        for (Index i = first; i < end; ++i)
            level += double(signal.levels[std::size_t(i)]) / count;
        const auto excess = [&](Index distance) {
            double sum = 0.0;
            double observed = 0.0;
            for (Index i = first; i < end; ++i) {
                const auto cell = Index(std::lround(signal.positions[std::size_t(i)])) + distance;
                if (const float y = strip.valueAt(from + i, cell); !std::isnan(y)) {
                    sum += double(y) - 1.0;
                    observed += 1.0;
                }
            }
            return observed > 0.0 ? sum / observed : 0.0;
        };
        std::vector<float> shares;
        double running = std::numeric_limits<double>::infinity();
        for (Index d = 0; d <= strip.halfWidth; ++d) {
            if (const Index outer = std::max(d, nearest); d == 0 || d > nearest)
                running = std::min({running, excess(outer), excess(-outer)});
            if (running <= 1.0 + 3.0 / std::sqrt(count))
                break;
            shares.push_back(float(running / std::max(level, 1e-9)));
        }
        return shares;
    }

} // namespace

ExplainedSignal explainPath(const PathStrip &strip, const BothWays &seen, Index from, Index to, double binsPerCell)
{
    const auto near = Index(std::floor(ownPowerCells * binsPerCell));
    ExplainedSignal signal;
    signal.firstFrame = strip.firstFrame + from;
    for (Index at = from; at < to; ++at) {
        const auto i = std::size_t(at);
        double power = seen.levels[i] + 1.0;
        for (Index d = -near; d <= near; ++d)
            if (const float y = strip.valueAt(at, Index(std::lround(seen.positions[i])) + d); !std::isnan(y))
                power = std::max(power, double(y));
        signal.positions.push_back(seen.positions[i]);
        signal.levels.push_back(float(power - 1.0));
    }
    if (strip.halfWidth >= skirtBins)
        for (Index first = 0; first < to - from; first += ExplainedSignal::skirtFrames)
            signal.skirts.push_back(skirtOf(strip, signal, from, first));
    return signal;
}

std::vector<ExplainedSignal> explainSubtracted(const PathStrip &strip, double binsPerCell)
{
    const auto near = Index(std::floor(ownPowerCells * binsPerCell));
    ExplainedSignal rest;
    rest.firstFrame = strip.firstFrame;
    for (Index at = 0; at < strip.frameCount(); ++at) {
        const Index centre = strip.centres[std::size_t(at)];
        float power = 0.0f;
        for (Index d = -near; d <= near; ++d)
            if (const float y = strip.valueAt(at, centre + d); !std::isnan(y))
                power = std::max(power, y);
        rest.positions.push_back(double(centre));
        rest.levels.push_back(power > rareNoisePower ? power - 1.0f : 0.0f);
    }
    ExplainedSignal skirts{rest.firstFrame, rest.positions, std::vector<float>(rest.levels.size(), 1.0f), {}};
    const auto notch = Index(std::ceil(notchCells * binsPerCell));
    bool hasSkirts = false;
    for (Index first = 0; first < strip.frameCount(); first += ExplainedSignal::skirtFrames) {
        skirts.skirts.push_back(skirtOf(strip, skirts, 0, first, notch));
        hasSkirts = hasSkirts || !skirts.skirts.back().empty();
    }
    std::vector<ExplainedSignal> signals{std::move(rest)};
    if (hasSkirts)
        signals.push_back(std::move(skirts));
    return signals;
}

} // namespace faintline
