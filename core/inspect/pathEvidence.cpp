#include "inspect/pathEvidence.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>

namespace faintline {

PathEvidence evidenceAlong(const Analysis &analysis, std::span<const PathCell> path, const RunContext &context)
{
    PathEvidence evidence;
    const Index cells = analysis.grid().size();
    std::vector<float> y(static_cast<std::size_t>(cells));
    double power = 0.0;
    Index unobserved = 0;
    for (const PathCell &at : path) {
        if (at.frame < 0 || at.frame >= analysis.time().count || at.cell < 0 || at.cell >= cells)
            throw Error("path at frame " + std::to_string(at.frame) + ", cell " + std::to_string(at.cell),
                        "lies outside the picture");
        if (evidence.frames % 64 == 0)
            context.checkpoint(double(evidence.frames) / double(path.size()), "evaluating a path");
        analysis.frames->read(at.frame, 1, y);
        const auto value = double(y[std::size_t(at.cell)]);
        evidence.logLikelihoodRatio += analysis.model.likelihood.at(value);
        if (std::isnan(value)) // not observed
            ++unobserved;
        else
            power += value;
        ++evidence.frames;
    }
    if (evidence.frames > unobserved)
        evidence.meanPower = power / double(evidence.frames - unobserved);
    return evidence;
}

std::vector<PathCell> cellsAlong(const Analysis &analysis, std::span<const PolylinePoint> line)
{
    std::vector<PathCell> path;
    if (line.empty())
        return path;
    const Axis &time = analysis.time();
    const Axis &frequency = analysis.grid().axes.back();
    const auto last = Index(std::floor(time.position(line.back().seconds) + 0.5));
    auto next = line.begin();
    for (Index frame = std::max<Index>(0, Index(std::ceil(time.position(line.front().seconds) - 0.5)));
         frame <= std::min(last, time.count - 1); ++frame) {
        const double seconds = std::clamp(time.value(double(frame)), line.front().seconds, line.back().seconds);
        while (next != line.end() && next->seconds < seconds)
            ++next;
        double hz = next->hz;
        if (next != line.begin() && next->seconds > seconds) {
            const PolylinePoint &before = *(next - 1);
            hz = before.hz + (next->hz - before.hz) * (seconds - before.seconds) / (next->seconds - before.seconds);
        }
        if (const auto cell = Index(std::lround(frequency.position(hz))); cell >= 0 && cell < frequency.count)
            path.push_back({frame, cell});
    }
    return path;
}

} // namespace faintline
