#include "inspect/closeup.h"

#include "plan/chain.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index blockValues = Index(1) << 18;

    PeakPyramid emptyPicture(const Analysis &analysis, const FrameStretch &stretch, ByteScale::Kind kind,
                             std::size_t byteBudget)
    {
        Axis time = analysis.time();
        time.first = time.value(double(stretch.begin));
        time.count = stretch.end - stretch.begin;
        return PeakPyramid(time, analysis.grid().size(), ByteScale(kind), byteBudget);
    }

    /// Calls `take` with blocks of frames, in order.
    template <class Take>
    void readFrames(const Analysis &analysis, const FrameStretch &frames, const RunContext &context, const Take &take)
    {
        const Index cells = analysis.grid().size();
        const Index most = std::max<Index>(1, blockValues / cells);
        std::vector<float> block;
        for (Index first = frames.begin; first < frames.end; first += most) {
            const double share = double(first - frames.begin) / double(frames.end - frames.begin);
            context.checkpoint(share, "computing the close-up");
            const Index count = std::min(most, frames.end - first);
            block.resize(std::size_t(count * cells));
            analysis.frames->read(first, count, block);
            take(first, block);
        }
    }

} // namespace

Index framesPerRowWithin(std::size_t byteBudget, Index frames, Index cells)
{
    Index merged = 1;
    while (4 * (frames / merged) * cells / 3 > Index(byteBudget))
        merged *= 4;
    return merged;
}

FrameStretch closeupStretch(const PeakPyramid &picture, const FrameStretch &visible, double framesPerPixel,
                            std::size_t byteBudget)
{
    const Index perRow = picture.framesPerRow(0);
    if (perRow == 1 || framesPerPixel >= double(perRow) || visible.isEmpty())
        return {};
    const auto widened = [&](Index by) {
        const Index begin = std::clamp<Index>(visible.begin - by, 0, picture.frameCount());
        return FrameStretch{begin - begin % perRow, std::clamp<Index>(visible.end + by, 0, picture.frameCount())};
    };
    const auto mergedIn = [&](const FrameStretch &one) {
        return framesPerRowWithin(byteBudget, one.end - one.begin, picture.cells());
    };
    constexpr Index atTheSides = 2; // pixels there may begin or end a frame farther out
    const FrameStretch least = widened(atTheSides);
    if (least.isEmpty() || mergedIn(least) >= perRow)
        return {};
    const FrameStretch more = widened(atTheSides + (visible.end - visible.begin) / 2);
    return mergedIn(more) == mergedIn(least) ? more : least;
}

std::shared_ptr<const PeakPyramid> inputCloseup(const Analysis &analysis, const FrameStretch &stretch,
                                                std::size_t byteBudget, const RunContext &context)
{
    auto picture = std::make_shared<PeakPyramid>(emptyPicture(analysis, stretch, ByteScale::Kind::PowerDb, byteBudget));
    readFrames(analysis, stretch, context, [&](Index, std::span<const float> block) { picture->append(block); });
    picture->finish();
    return picture;
}

std::shared_ptr<const PeakPyramid> statisticCloseup(const Analysis &analysis, const FrameStretch &stretch,
                                                    std::size_t byteBudget, const RunContext &context)
{
    auto picture =
        std::make_shared<PeakPyramid>(emptyPicture(analysis, stretch, ByteScale::Kind::ScoreNats, byteBudget));
    const std::unique_ptr<DetectionChain> chain = makeScoringChain(analysis);
    FrameStretch way{0, stretch.end};
    if (const Index latest = analysis.checkpoints.latest(stretch.begin); latest > 0) {
        chain->setState(*analysis.checkpoints.at(latest));
        way.begin = latest;
    }

    const auto cells = std::size_t(analysis.grid().size());
    std::vector<float> statistic(cells);
    readFrames(analysis, way, context, [&](Index first, std::span<const float> block) {
        for (Index i = 0; i < std::ssize(block) / Index(cells); ++i) {
            chain->update(first + i, block.subspan(std::size_t(i) * cells, cells), statistic);
            if (first + i >= stretch.begin)
                picture->append(statistic);
        }
    });
    picture->finish();
    return picture;
}

} // namespace faintline
