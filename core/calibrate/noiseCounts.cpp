#include "calibrate/noiseCounts.h"

#include "plan/chain.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace faintline {

namespace {

    constexpr Index framesAtOnce = 64;

    double countedCellFrames(const NormalisedFrames &noise)
    {
        return double(noise.grid().size() * std::max<Index>(0, noise.time().count - settlingFrames));
    }

    /// Calls take(first, y, statistic) for each block of frames; `statistic` is room for theirs.
    template <class Take>
    void forEachBlock(const NormalisedFrames &noise, Take take)
    {
        const auto cells = std::size_t(noise.grid().size());
        std::vector<float> batch(framesAtOnce * cells);
        std::vector<float> statistic(batch.size());
        for (Index first = 0; first < noise.time().count; first += framesAtOnce) {
            const Index count = std::min(framesAtOnce, noise.time().count - first);
            const std::span<float> y = std::span(batch).first(std::size_t(count) * cells);
            noise.read(first, count, y);
            take(first, std::span<const float>(y), std::span(statistic).first(y.size()));
        }
    }

} // namespace

std::shared_ptr<const FrameArray> beginningOf(const NormalisedFrames &noise, Index frames)
{
    Axis time = noise.time();
    time.count = std::min(time.count, frames);
    std::vector<float> values(std::size_t(time.count * noise.grid().size()));
    noise.read(0, time.count, values);
    return std::make_shared<FrameArray>(time, noise.grid(), std::move(values));
}

StatisticLevels statisticLevelsOf(const NormalisedFrames &noise, Detector &detector)
{
    const auto cells = std::size_t(noise.grid().size());
    std::vector<float> y(cells);
    std::vector<float> statistic(cells);
    float least = std::numeric_limits<float>::infinity();
    float largest = -least;
    for (Index frame = 0; frame < noise.time().count; ++frame) {
        noise.read(frame, 1, y);
        detector.update(y, statistic);
        if (frame < settlingFrames)
            continue;
        for (const float value : statistic)
            if (std::isfinite(value)) {
                least = std::min(least, value);
                largest = std::max(largest, value);
            }
    }
    if (!(least <= largest))
        return {}; // never decided anything
    return {least, std::max((largest - least) / float(levelsInView), 1e-6f)};
}

NoiseTail measureTail(const NormalisedFrames &noise, Detector &detector, const StatisticLevels &levels)
{
    const Index cells = noise.grid().size();
    const Index columns = std::max<Index>(1, cells / noiseBlockCells);
    std::vector<float> maxima(static_cast<std::size_t>(columns));
    NoiseTail tail;
    Index inBlock = 0;
    const auto count = [&](std::span<const float> statistic) {
        for (float value : statistic) {
            const float position = (value - levels.lowest) / levels.step;
            tail.counts[std::size_t(std::clamp(position, 0.0f, float(levelCount - 1)))] += 1.0;
        }
        if (inBlock == 0)
            std::fill(maxima.begin(), maxima.end(), -std::numeric_limits<float>::infinity());
        for (Index column = 0; column < columns; ++column) {
            const auto from = statistic.begin() + column * cells / columns;
            const auto to = statistic.begin() + (column + 1) * cells / columns;
            float &maximum = maxima[std::size_t(column)];
            maximum = std::max(maximum, *std::max_element(from, to));
        }
        if (++inBlock == noiseBlockFrames) {
            tail.blockMaxima.insert(tail.blockMaxima.end(), maxima.begin(), maxima.end());
            inBlock = 0;
        }
    };
    forEachBlock(noise, [&](Index first, std::span<const float> y, std::span<float> statistic) {
        detector.updateBlock(y, statistic, cells);
        const Index settling = std::clamp<Index>(settlingFrames - first, 0, std::ssize(y) / cells);
        for (std::size_t at = std::size_t(settling * cells); at < y.size(); at += std::size_t(cells))
            count(statistic.subspan(at, std::size_t(cells)));
    });
    tail.cellFrames = countedCellFrames(noise);
    return tail;
}

EventCounts countEvents(const AnalysisPlan &plan, std::span<const double> thresholds, bool onlyAtLast)
{
    AnalysisPlan own = plan;
    std::vector<std::unique_ptr<DetectionChain>> chains;
    const std::size_t leftOut = onlyAtLast ? thresholds.size() - 1 : 0;
    for (const double threshold : thresholds.subspan(leftOut)) {
        own.threshold = threshold;
        chains.push_back(makeChain(own, makePathDetector(own), false));
    }
    const NormalisedFrames &noise = *plan.frames;
    forEachBlock(noise, [&](Index first, std::span<const float> y, std::span<float> statistic) {
        for (const auto &chain : chains)
            chain->updateAll(first, y, statistic);
    });
    EventCounts counts{std::vector(leftOut, 0.0), std::vector(leftOut, 0.0)};
    for (const auto &chain : chains) {
        chain->finish();
        counts.events.push_back(double(std::ranges::count_if(
            chain->tracks(), [](Index frame) { return frame >= settlingFrames; }, &Track::detectFrame)));
        counts.cellFrames.push_back(countedCellFrames(noise));
    }
    return counts;
}

void add(const NoiseTail &part, NoiseTail &whole)
{
    std::transform(part.counts.begin(), part.counts.end(), whole.counts.begin(), whole.counts.begin(), std::plus<>());
    whole.blockMaxima.insert(whole.blockMaxima.end(), part.blockMaxima.begin(), part.blockMaxima.end());
    whole.cellFrames += part.cellFrames;
}

void add(const EventCounts &part, EventCounts &whole)
{
    whole.events.resize(part.events.size());
    whole.cellFrames.resize(part.events.size());
    std::transform(part.events.begin(), part.events.end(), whole.events.begin(), whole.events.begin(), std::plus<>());
    std::transform(part.cellFrames.begin(), part.cellFrames.end(), whole.cellFrames.begin(), whole.cellFrames.begin(),
                   std::plus<>());
}

} // namespace faintline
