#include "refine/searchBehind.h"

#include "frames/FrameStream.h"
#include "plan/chain.h"
#include "plan/sureStatistic.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double hidingNatsPerFrame = 0.05; ///< nat per frame
    constexpr double raisedFloorRatio = 1.5;    ///< floor from which on a cell may have been hidden from the first run
    constexpr double hiddenShareLimit = 0.5;    ///< of a track's points that lie near such cells

    /// y at which λ has a value; λ increases with y.
    double powerOf(const Likelihood &likelihood, double lambda)
    {
        double low = 0.0;
        double high = 50.0;
        for (int i = 0; i < 60; ++i) {
            const double middle = 0.5 * (low + high);
            (likelihood.at(middle) < lambda ? low : high) = middle;
        }
        return low;
    }

    /// Share of a track's points at which stronger signals raise the floor in its cell or up to `reach` beside it.
    double hiddenShare(const Track &track, const Explanations &explanations, Index reach)
    {
        std::vector<float> floor(std::size_t(2 * reach + 1));
        double hidden = 0.0;
        for (const TrackPoint &point : track.points) {
            explanations.read(point.frame, point.cell - reach, floor);
            hidden += *std::max_element(floor.begin(), floor.end()) >= float(raisedFloorRatio) ? 1.0 : 0.0;
        }
        return hidden / double(track.points.size());
    }

} // namespace

std::vector<Track> searchBehind(const Analysis &analysis, const Explanations &explanations, const RunContext &context)
{
    const NormalisedFrames &frames = *analysis.frames;
    const Index cells = frames.grid().size();
    const Index frameCount = frames.time().count;
    const KinematicAxis &axis = analysis.model.space.axes().front();
    const auto hidden =
        float(powerOf(analysis.model.likelihood,
                      -(analysis.calibration->lnK + std::log(axis.rateChange.front())) - hidingNatsPerFrame));
    std::unique_ptr<PathDetector> detector = makePathDetector(analysis);
    detector->useThreads(context.threads);
    const auto chain = makeChain(analysis, std::move(detector));
    std::vector<float> floor(static_cast<std::size_t>(cells));
    std::vector<float> statistic(floor.size());
    FrameStream stream(frames, context.threads > 1);
    for (std::vector<float> block = stream.next(); !block.empty(); block = stream.next()) {
        const Index first = stream.position() - std::ssize(block) / cells;
        context.checkpoint(double(first) / double(frameCount), "searching behind strong signals");
        for (Index i = 0; i < std::ssize(block) / cells; ++i) {
            const std::span<float> y = std::span(block).subspan(std::size_t(i * cells), floor.size());
            explanations.read(first + i, 0, floor);
            for (std::size_t cell = 0; cell < floor.size(); ++cell)
                y[cell] /= floor[cell];
            explanations.hide(first + i, 0, y, hidden);
            chain->update(first + i, y, statistic);
        }
    }
    chain->finish();
    std::vector<Track> found = chain->takeJoinedTracks();
    const auto reach = Index(std::ceil(frames.spectrogram()->binsPerCell()));
    const double sure = sureStatistic(analysis);
    std::erase_if(found, [&](const Track &track) {
        return track.peakStatistic < sure || hiddenShare(track, explanations, reach) < hiddenShareLimit;
    });
    return found;
}

} // namespace faintline
