#include "spectrum/NoiseBackground.h"

#include "base/memoryShares.h"
#include "spectrum/addStretch.h"
#include "spectrum/averageWhileSteady.h"
#include "spectrum/bandLevels.h"
#include "spectrum/blockBackground.h"
#include "spectrum/coarseFrames.h"
#include "spectrum/edgeCorrection.h"
#include "spectrum/unevenness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    constexpr int framesPerBlock = 512;              // longer blocks are subsampled
    constexpr Index valuesPerBlock = Index(1) << 22; // as are blocks of many cells
    constexpr Index fewestFramesPerBlock = 64;
    constexpr int sketchFrames = 64;
    constexpr Index largestBlockCount = 1024;
    /// Nine hours at 48 kHz; beyond that, blocks are longer.
    constexpr Index largestValueCount = memoryShares::background / sizeof(float);

    /// The detector's frames between two windows, up to three: spectra of windows that each begin a hop later.
    std::vector<Spectrogram> betweenWindows(const Spectrogram &detector, const Spectrogram &windows)
    {
        constexpr Index most = 4;
        std::vector<Spectrogram> result;
        const Index steps = std::min<Index>(detector.settings().stepsPerWindow, most);
        const double rate = detector.recording().info().sampleRateHz;
        for (Index shift = 1; shift < steps; ++shift) {
            SelectionSettings later = windows.selection();
            later.fromSeconds += std::round(double(shift * windows.windowSamples()) / double(steps)) / rate;
            if (detector.time().count <= detector.settings().stepsPerWindow)
                return {}; // hardly longer than a window
            result.emplace_back(windows.recordingPointer(), windows.settings(), later);
        }
        return result;
    }

    /// Frames for estimating a background, in blocks.
    struct BlockedFrames {
        const Spectrogram &frames;
        const std::vector<Spectrogram> &shifted;
        Index steps;
        double blockFrames;

        Index blockBegin(Index block) const
        {
            return std::min(frames.time().count, Index(std::floor(double(block) * blockFrames)));
        }
    };

    /// Decomposes stretches of a dozen blocks whose colour changes into sources.
    void addStretches(NoiseBackground &background, const BlockedFrames &blocked, const std::vector<Unevenness> &changes,
                      Index half, double likeness, std::vector<float> &levels)
    {
        constexpr Index stretchBlocks = 13;
        constexpr double noticeable = 1.5;
        const Index blockCount = std::ssize(changes);
        const double expected = Unevenness::ofNoise(likeness);
        const Index together = std::clamp<Index>(
            Index(double(valuesPerBlock / background.frequency.count) / blocked.blockFrames), 1, stretchBlocks);
        for (Index block = 0; block < blockCount; block += together) {
            const Index next = std::min(blockCount, block + together);
            Unevenness change;
            for (Index each = block; each < next; ++each) {
                change.sum += changes[std::size_t(each)].sum;
                change.freedom += changes[std::size_t(each)].freedom;
            }
            const Index first = blocked.blockBegin(block);
            const Index end = next < blockCount ? blocked.blockBegin(next) : blocked.frames.time().count;
            if (change.variance() > noticeable * expected)
                addStretch(background, {first, end - first, blocked.steps, blocked.frames, blocked.shifted}, half,
                           likeness, levels);
        }
    }

} // namespace

std::shared_ptr<const NoiseBackground> estimateBackground(const Spectrogram &spectrogram,
                                                          const NormaliserSettings &settings, const RunContext &context,
                                                          BackgroundDepth depth)
{
    const bool isSketch = depth == BackgroundDepth::Sketch;
    const Spectrogram frames = coarseFrames(spectrogram, settings, 1);
    const std::vector<float> window = sampleWindow(frames.settings().window, frames.windowSamples());
    const double likeness = cellLikeness(window);

    const Index frameCount = frames.time().count;
    const Index cells = frames.frequency().count;
    const Index mostBlocks = std::clamp<Index>(largestValueCount / std::max<Index>(1, cells), 1, largestBlockCount);
    const Index framesWanted =
        std::max(Index(std::llround(settings.blockWindows)), (frameCount + mostBlocks - 1) / mostBlocks);
    const Index blockCount = isSketch ? 1 : std::max<Index>(1, frameCount / framesWanted);
    const double blockFrames = double(frameCount) / double(blockCount);

    auto background = std::make_shared<NoiseBackground>();
    const double step = blockFrames * frames.time().step;
    background->time = {"time", "s",        frames.time().first + 0.5 * (blockFrames - 1.0) * frames.time().step,
                        step,   blockCount, false};
    background->frequency = frames.frequency();
    background->lnUnit = 2.0 * std::numbers::ln2 * frames.scaleExponent();

    // Selected frames lie on one even raster over all blocks; every frame is used if there are not too many.
    const auto mostUsed = double(
        isSketch ? sketchFrames
                 : std::clamp<Index>(valuesPerBlock / std::max<Index>(1, cells), fewestFramesPerBlock, framesPerBlock));
    const Index stride = Index(std::ceil(blockFrames / mostUsed));
    background->bandCount = settings.followLevel && !isSketch ? NoiseBackground::subBandCount(double(cells)) : 0;
    // Levels are computed for the detector's own, overlapping frames, because a sudden change between windows could
    // only be guessed.
    const std::vector<Spectrogram> shifted =
        stride == 1 && background->bandCount > 0 ? betweenWindows(spectrogram, frames) : std::vector<Spectrogram>{};
    const Index steps = std::ssize(shifted) + 1;
    background->levelTime = {"time",
                             "s",
                             frames.time().first,
                             double(stride) * frames.time().step / double(steps),
                             (frameCount + stride - 1) / stride * steps,
                             false};
    const Index columns = background->bandCount + 1;
    std::vector<float> levels(background->bandCount > 0 ? std::size_t(background->levelTime.count * columns) : 0,
                              levelNotKnown);
    std::vector<Index> blockOfLevel(std::size_t(background->levelTime.count), blockCount - 1);
    BlockRows rows;
    rows.lnPower.reserve(std::size_t(blockCount * cells));
    background->lnPower.reserve(std::size_t(blockCount * cells));
    std::vector<Unevenness> changes; // of each block
    std::vector<LevelOffsets> offsets;
    std::vector<float> block;
    for (Index b = 0; b < blockCount; ++b) {
        context.checkpoint(double(b) / double(blockCount), "noise background");
        const auto first = Index(std::floor(double(b) * blockFrames));
        const auto end = std::min(frameCount, Index(std::floor(double(b + 1) * blockFrames)));
        const Index firstUsed = (first + stride - 1) / stride * stride;
        const Index used = (end - firstUsed + stride - 1) / stride;
        block.resize(std::size_t(used * cells));
        for (Index i = 0; i < (stride > 1 ? used : 1); ++i)
            frames.read(firstUsed + i * stride, stride > 1 ? 1 : used,
                        std::span(block).subspan(std::size_t(i * cells), std::size_t((stride > 1 ? 1 : used) * cells)));
        const std::vector<float> taken =
            background->bandCount > 0 ? flatten(block, cells) : std::vector<float>(std::size_t(used), 0.0f);
        const BlockBackground own = blockBackground(block, cells, settings.halfWidthCells);
        background->lnPower.insert(background->lnPower.end(), own.medians.begin(), own.medians.end());
        rows.lnPower.insert(rows.lnPower.end(), own.lnPower.begin(), own.lnPower.end());
        rows.isNoise.insert(rows.isNoise.end(), own.isNoise.begin(), own.isNoise.end());
        if (background->bandCount == 0)
            continue;
        const std::vector<float> measured = levelsOf(block, own, background->bandCount, likeness);
        offsets.emplace_back(measured, columns);
        if (stride == 1)
            changes.push_back(changesOf(block, own, measured, background->bandCount));
        const auto put = [&](const std::vector<float> &source, Index row, Index place, float more) {
            for (Index column = 0; column < columns; ++column)
                if (const float level = source[std::size_t(row * columns + column)]; level < levelNotKnown)
                    levels[std::size_t(place * columns + column)] = level + more;
        };
        std::fill_n(blockOfLevel.begin() + firstUsed / stride * steps, used * steps, b);
        for (Index i = 0; i < used; ++i)
            put(measured, i, (firstUsed / stride + i) * steps, taken[std::size_t(i)]);
        for (Index shift = 1; shift < steps; ++shift) {
            const Spectrogram &other = shifted[std::size_t(shift - 1)];
            const Index there = std::min(used, other.time().count - first);
            if (there <= 0)
                continue;
            const auto values = std::span(block).first(std::size_t(there * cells));
            other.read(first, there, values);
            const std::vector<float> more = levelsOf(values, own, background->bandCount, likeness);
            for (Index i = 0; i < there; ++i)
                put(more, i, (first + i) * steps + shift, 0.0f);
        }
    }
    averageWhileSteady(background->lnPower, rows.lnPower, cells, settings.halfWidthCells,
                       std::min(mostUsed, blockFrames));
    if (background->bandCount > 0) {
        removeOffsets(levels, offsets, blockOfLevel);
        moveToBackground(levels, rows, *background, blockOfLevel);
    }
    const double overlap = overlapFactor(window, int(steps));
    background->lnLevel = finishLevels(levels, *background, overlap, likeness);
    if (background->bandCount > 0 && stride == 1) {
        addStretches(*background, {frames, shifted, steps, blockFrames}, changes, settings.halfWidthCells, likeness,
                     levels);
        if (!background->stretches.empty())
            background->lnLevel = finishLevels(levels, *background, overlap, likeness);
    }
    if (!isSketch) {
        background->bins = spectrogram.frequency();
        background->lnAtEdges = edgeCorrection(spectrogram, *background);
    }
    return background;
}

} // namespace faintline
