#include "analysis/explain.h"

#include "analysis/chain.h"
#include "base/Error.h"
#include "detect/Smd.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// The chain as it stands after the given frame. The statistic of that frame is left in `statistic`.
    std::unique_ptr<DetectionChain> runTo(const Analysis &analysis, Index frame, std::vector<float> &statistic, const RunContext &context)
    {
        auto chain = makeChain(analysis);
        std::vector<float> y(static_cast<std::size_t>(analysis.grid().size()));
        statistic.resize(y.size());
        for (Index t = 0; t <= frame; ++t) {
            if (t % 64 == 0)
                context.checkpoint(static_cast<double>(t) / static_cast<double>(frame + 1), "going through it again");
            analysis.frames->read(t, 1, y);
            chain->update(t, y, statistic);
        }
        return chain;
    }

    /// What a model's scores are raised by in the chain's newest frame to be the statistic.
    double offsetOf(const Analysis &analysis, const DetectionChain &chain, std::size_t model)
    {
        const auto *smd = dynamic_cast<const Smd *>(&chain.detector().member(model));
        return (smd ? smd->offset() : 0.0) - (analysis.bank.empty() ? 0.0 : analysis.bank[model].offset);
    }

} // namespace

Explanation explain(const Analysis &analysis, double seconds, const std::vector<double> &position, const RunContext &context)
{
    const Axis &time = analysis.time();
    const double half = 0.5 * time.step;
    if (!(seconds >= time.first - half && seconds <= time.last() + half))
        throw Error("time " + formatNumber(seconds) + " s", "must lie in " + formatNumber(time.first) + " … " + formatNumber(time.last()) + " s");
    const Index frame = time.nearest(seconds);
    std::vector<Index> coordinates;
    for (std::size_t axis = 0; axis < position.size(); ++axis) {
        if (std::isnan(position[axis]))
            throw Error(analysis.grid().axes[axis].name + " nan", "must be a number");
        const Axis &along = analysis.grid().axes[axis];
        if (const double at = along.position(position[axis]);
            !along.cyclic && !(at >= -0.5 && at <= static_cast<double>(along.count) - 0.5))
            throw Error(along.name + " " + formatNumber(position[axis]) + " " + along.unit,
                        "must lie in " + formatNumber(along.first) + " … " + formatNumber(along.last()) + " " + along.unit);
        coordinates.push_back(along.nearest(position[axis]));
    }
    const Index cell = analysis.grid().cell(coordinates);

    // A tracker's path goes on to its very beginning only if it keeps all of its history, which changes no score.
    Analysis detailed = analysis;
    detailed.settings.track.smoothingFrames = static_cast<int>(std::min<Index>(frame + 1, 1 << 30));
    std::vector<float> statistic;
    const auto chain = runTo(detailed, frame, statistic, context.part(0.0, 0.6));
    const DetectionChain::PathInto path = chain->pathInto(cell);

    Explanation explanation;
    explanation.seconds = time.value(static_cast<double>(frame));
    for (std::size_t axis = 0; axis < coordinates.size(); ++axis)
        explanation.position.push_back(analysis.grid().axes[axis].value(static_cast<double>(coordinates[axis])));
    explanation.displayed = static_cast<double>(statistic[static_cast<std::size_t>(cell)]);
    explanation.threshold = analysis.threshold;
    explanation.isTracked = path.isTracked;
    explanation.steps = path.steps;
    explanation.model = path.model;
    explanation.offset = offsetOf(detailed, *chain, path.model);
    if (path.isTracked) {
        // Before its tracker was seeded, the path is the detector's own.
        const PathStep seed = path.steps.front();
        const auto before = runTo(detailed, seed.frame, statistic, context.part(0.6, 1.0));
        explanation.steps = before->detectorPathInto(seed.state, path.model);
        explanation.offset = offsetOf(detailed, *before, path.model);
        explanation.steps.insert(explanation.steps.end(), path.steps.begin() + 1, path.steps.end());
    }
    for (PathStep &step : explanation.steps) {
        explanation.statistic += step.logLikelihoodRatio + step.lnTransition + step.lnK;
        step.score = explanation.statistic;
    }
    explanation.statistic += explanation.offset;
    return explanation;
}

} // namespace faintline
