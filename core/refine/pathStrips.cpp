#include "refine/pathStrips.h"

#include "frames/Spectrogram.h"
#include "plan/chain.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr std::size_t readBlockBytes = std::size_t(1) << 20;
    constexpr std::size_t stripBytes = std::size_t(16) << 20; ///< of strips read in one pass

    void copyFrame(std::span<const float> y, Index at, PathStrip &strip)
    {
        if (at < 0 || at >= strip.frameCount())
            return;
        const Index first = strip.firstCell(at);
        const Index from = std::clamp<Index>(first, 0, std::ssize(y));
        const Index to = std::clamp<Index>(first + strip.width(), 0, std::ssize(y));
        if (from < to)
            std::copy(y.begin() + from, y.begin() + to, strip.row(at) + (from - first));
    }

    void readFrom(const NormalisedFrames &frames, const std::vector<CellBox> &excluded, std::vector<PathStrip *> strips,
                  const RunContext &context, std::string_view what)
    {
        std::stable_sort(strips.begin(), strips.end(),
                         [](const PathStrip *a, const PathStrip *b) { return a->firstFrame < b->firstFrame; });
        const Index cells = frames.grid().size();
        const Index frameCount = frames.time().count;
        const Index block = std::max<Index>(1, Index(readBlockBytes / sizeof(float)) / cells);
        std::vector<PathStrip *> open;
        std::size_t next = 0;
        std::vector<float> values;
        for (Index first = 0; first < frameCount && (next < strips.size() || !open.empty()); first += block) {
            context.checkpoint(double(first) / double(frameCount), what);
            const Index count = std::min(block, frameCount - first);
            for (; next < strips.size() && strips[next]->firstFrame < first + count; ++next) {
                PathStrip &strip = *strips[next];
                strip.y.assign(std::size_t(strip.frameCount() * strip.width()),
                               std::numeric_limits<float>::quiet_NaN());
                open.push_back(&strip);
            }
            std::erase_if(open,
                          [first](const PathStrip *strip) { return strip->firstFrame + strip->frameCount() <= first; });
            if (open.empty())
                continue;
            values.resize(std::size_t(count * cells));
            frames.read(first, count, values);
            for (Index i = 0; i < count; ++i) {
                const std::span<float> y = std::span(values).subspan(std::size_t(i * cells), std::size_t(cells));
                for (const CellBox &box : excluded)
                    box.forEachCell(frames.grid(), [&](Index cell) {
                        if (float &power = y[std::size_t(cell)]; !std::isnan(power))
                            power = 0.0f;
                    });
                for (PathStrip *strip : open)
                    copyFrame(y, first + i - strip->firstFrame, *strip);
            }
        }
    }

    std::vector<PathStrip *> pointersTo(std::span<PathStrip> strips)
    {
        std::vector<PathStrip *> all;
        for (PathStrip &strip : strips)
            all.push_back(&strip);
        return all;
    }

} // namespace

void readStrips(const Analysis &analysis, std::vector<PathStrip *> strips, const RunContext &context,
                std::string_view what)
{
    readFrom(*analysis.frames, excludedBoxes(analysis), std::move(strips), context, what);
}

void readStrips(const Analysis &analysis, std::span<PathStrip> strips, const RunContext &context, std::string_view what)
{
    readStrips(analysis, pointersTo(strips), context, what);
}

void readStrips(const NormalisedFrames &frames, std::span<PathStrip> strips, const RunContext &context,
                std::string_view what)
{
    readFrom(frames, {}, pointersTo(strips), context, what);
}

void readInTurn(const Analysis &analysis, const std::vector<PathStrip *> &strips, const RunContext &context,
                std::string_view what, const std::function<void(std::size_t)> &take)
{
    const auto done = [&](std::size_t strip) { return double(strip) / double(strips.size()); };
    for (std::size_t first = 0; first < strips.size();) {
        std::vector<PathStrip *> together;
        for (std::size_t bytes = 0; first + together.size() < strips.size() && bytes < stripBytes;) {
            together.push_back(strips[first + together.size()]);
            bytes += sizeof(float) * std::size_t(together.back()->frameCount() * together.back()->width());
        }
        const std::size_t end = first + together.size();
        readStrips(analysis, std::move(together), context.part(done(first), 0.5 * (done(first) + done(end))), what);
        for (; first < end; ++first) {
            context.checkpoint(done(end), what);
            take(first);
            *strips[first] = {};
        }
    }
}

PathStrip stripAlong(const Track &track, Index halfWidth)
{
    PathStrip strip;
    strip.firstFrame = track.points.front().frame;
    strip.halfWidth = halfWidth;
    for (const TrackPoint &point : track.points)
        strip.centres.push_back(point.cell);
    return strip;
}

BothWaysModel bothWaysModel(const Analysis &analysis)
{
    BothWaysModel model;
    model.axis = &analysis.model.space.axes().front();
    model.likelihood = analysis.model.likelihood;
    model.threshold = isScoreOfPaths(analysis.settings.detector) ? analysis.threshold : analysis.settings.track.endNats;
    model.binsPerCell = analysis.frames->geometry().binsPerCell;
    return model;
}

void setLnK(BothWaysModel &model, const Analysis &analysis, const PathStrip &strip)
{
    const auto first = analysis.lnK.begin() + (strip.firstFrame - analysis.firstLnK);
    model.lnK.assign(first, first + strip.frameCount());
}

} // namespace faintline
