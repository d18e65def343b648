#include "spectrum/NoiseBackground.h"

#include "base/memoryShares.h"
#include "base/multiversion.h"
#include "spectrum/levels.h"
#include "spectrum/medians.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>

namespace faintline {

namespace {

    constexpr int framesPerBlock = 512; // longer blocks are looked at here and there
    constexpr Index valuesPerBlock = Index(1) << 22; // so are those of many cells
    constexpr Index fewestFramesPerBlock = 64;
    constexpr int sketchFrames = 64;
    constexpr Index largestBlockCount = 1024;
    constexpr Index largestValueCount = memoryShares::background / sizeof(float); ///< nine hours at 48 kHz; beyond that blocks are longer
    constexpr float silence = NoiseBackground::silence;
    // Rounding of the single-precision transform, relative to the frame's strongest bin: nothing below it is noise.
    constexpr double roundingFloor = 1e-13;
    constexpr double roundingMargin = 4.0; // of ln power: what lies no higher above the floor does not tell the noise's level

    /// Mean of ratio e^(value-median) over the cells within ±half that are not lines; answers which are not.
    std::vector<bool> refine(const std::vector<float> &values, std::vector<float> &medians, Index half, double mostRatio)
    {
        constexpr double fewestCells = 3.0;
        std::vector<double> ratios(values.size());
        std::vector<double> weights(values.size());
        std::vector<bool> isNoise(values.size());
        for (std::size_t k = 0; k < values.size(); ++k) {
            const double ratio = std::exp(static_cast<double>(values[k] - medians[k]));
            isNoise[k] = ratio < mostRatio && ratio > 1.0 / mostRatio;
            ratios[k] = isNoise[k] ? ratio : 0.0;
            weights[k] = isNoise[k] ? 1.0 : 0.0;
        }
        std::vector<double> mean(values.size());
        runningMean(ratios, weights, half, mean, fewestCells);
        for (std::size_t k = 0; k < values.size(); ++k)
            medians[k] += static_cast<float>(std::log(mean[k]));
        return isNoise;
    }

    /// What one block of frames says about its cells.
    struct BlockBackground {
        std::vector<float> lnPower; ///< ln mean noise power
        std::vector<bool> isNoise;  ///< false where a line lies all through the block, and where there is but rounding
    };

    /// The background under one block of frames (frames × cells).
    BlockBackground blockBackground(const std::vector<float> &frames, Index cells, Index half)
    {
        const Index frameCount = std::ssize(frames) / cells;
        std::vector<float> loud; // the frames that are no digital silence
        double strongest = 0.0;
        for (Index frame = 0; frame < frameCount; ++frame) {
            const auto row = frames.begin() + frame * cells;
            const float peak = *std::max_element(row, row + cells);
            strongest = std::max(strongest, static_cast<double>(peak));
            if (peak > 0.0f)
                loud.insert(loud.end(), row, row + cells);
        }
        std::vector<float> ln(static_cast<std::size_t>(cells), silence);
        if (loud.empty())
            return {std::move(ln), std::vector<bool>(static_cast<std::size_t>(cells), true)};
        const auto used = static_cast<int>(std::ssize(loud) / cells);
        const double bias = std::log(medianMean(used));
        const double floor = std::log(strongest * roundingFloor);
        columnMedians(loud, ln);
        for (float &value : ln) {
            const auto power = static_cast<double>(value);
            value = static_cast<float>(std::max(floor, power > 0.0 ? std::log(power) - bias : floor));
        }
        std::vector<float> background = runningMedian(ln, half);
        std::vector<bool> isNoise = refine(ln, background, half, 1.0 + 5.0 / std::sqrt(static_cast<double>(used)));
        for (std::size_t cell = 0; cell < background.size(); ++cell) {
            isNoise[cell] = isNoise[cell] && static_cast<double>(background[cell]) > floor + roundingMargin;
            background[cell] = std::max(background[cell], static_cast<float>(floor));
        }
        return {std::move(background), std::move(isNoise)};
    }

    /// How much higher a whole row of ln powers lies than another: the median difference, of 500 cells if there are more; 0 where it
    /// may be chance.
    float levelBetween(const float *upper, const float *lower, Index cells, double framesUsed)
    {
        std::vector<float> differences;
        const Index stride = (cells + 499) / 500;
        for (Index cell = 0; cell < cells; cell += stride)
            differences.push_back(upper[cell] - lower[cell]);
        const float level = medianOf(differences);
        const double chance = 3.0 * 1.44 * std::sqrt(2.0 * 2.0 / (framesUsed * static_cast<double>(cells)));
        return static_cast<double>(std::abs(level)) < chance ? 0.0f : level;
    }

    /// Averages each block with its neighbours in time as far as the noise keeps its colour: stationary noise is known better than one
    /// block tells. What the whole band's level does meanwhile is taken out; a step of more than a factor of e ends the average, and so
    /// does, for each cell, more than four standard errors of a difference of two blocks, which are a median's of `framesUsed` × window
    /// cells, and of fewer toward the band's edges, where the window is continued from a few of them.
    std::vector<float> averageWhileSteady(const std::vector<float> &ln, Index blocks, Index cells, Index half, double framesUsed)
    {
        constexpr Index reach = 6;
        std::vector<float> tolerance(static_cast<std::size_t>(cells));
        for (Index cell = 0; cell < cells; ++cell) {
            const double inward = static_cast<double>(std::min({cell, cells - 1 - cell, half})) / static_cast<double>(half);
            const double effective = pivotCells + (2.0 * static_cast<double>(half) + 1.0 - pivotCells) * inward;
            tolerance[static_cast<std::size_t>(cell)] = static_cast<float>(4.0 * 1.44 * std::sqrt(2.0 / (framesUsed * effective / 2.0)));
        }
        std::vector<float> result = ln;
        std::vector<float> count(tolerance.size());
        std::vector<char> goesOn(tolerance.size());
        for (Index block = 0; block < blocks; ++block) {
            const float *own = ln.data() + block * cells;
            float *sum = result.data() + block * cells;
            std::fill(count.begin(), count.end(), 1.0f);
            for (Index direction : {-1, 1}) {
                std::fill(goesOn.begin(), goesOn.end(), 1);
                for (Index i = 1; i <= reach; ++i) {
                    const Index other = block + direction * i;
                    if (other < 0 || other >= blocks)
                        break;
                    const float *values = ln.data() + other * cells;
                    const float level = levelBetween(values, own, cells, framesUsed);
                    if (std::abs(level) > 1.0f)
                        break;
                    for (std::size_t cell = 0; cell < tolerance.size(); ++cell) {
                        const float difference = values[cell] - level - own[cell];
                        if (!goesOn[cell] || std::abs(difference) > tolerance[cell]) {
                            goesOn[cell] = 0;
                            continue;
                        }
                        sum[cell] += own[cell] + difference;
                        count[cell] += 1.0f;
                    }
                }
            }
            for (std::size_t cell = 0; cell < tolerance.size(); ++cell)
                sum[cell] /= count[cell];
        }
        return result;
    }

    /// First cell of a sub-band; column `bands` is the whole band.
    Index firstCell(Index column, Index bands, Index cells)
    {
        return column == bands ? 0 : column * cells / bands;
    }

    Index endCell(Index column, Index bands, Index cells)
    {
        return column == bands ? cells : (column + 1) * cells / bands;
    }

    /// ln of each frame's level over its block's background: per sub-band the median cell of noise, then the whole band's common one, from
    /// the sub-bands that agree with the median sub-band. 0 in digital silence. Sub-bands that are mostly lines or empty have no say in
    /// what is common, and go with it where nothing of them is noise.
    void appendLevels(const std::vector<float> &frames, const BlockBackground &block, Index bands, std::vector<float> &levels)
    {
        if (bands == 0)
            return;
        constexpr std::ptrdiff_t fewestCells = 24;
        constexpr float notKnown = std::numeric_limits<float>::max();
        const Index cells = std::ssize(block.lnPower);
        std::vector<float> inverse(static_cast<std::size_t>(cells));
        for (std::size_t cell = 0; cell < inverse.size(); ++cell)
            inverse[cell] = block.lnPower[cell] > silence ? std::exp(-block.lnPower[cell]) : 0.0f;
        const auto agreeing = static_cast<float>(4.0 * medianScatter(static_cast<double>(cells) / static_cast<double>(bands)));
        std::vector<float> sample;
        std::vector<float> few;
        std::vector<Index> telling;
        for (Index frame = 0; frame < std::ssize(frames) / cells; ++frame) {
            const auto collect = [&](Index band) {
                for (Index cell = firstCell(band, bands, cells); cell < endCell(band, bands, cells); ++cell)
                    if (const auto c = static_cast<std::size_t>(cell); block.isNoise[c])
                        sample.push_back(frames[static_cast<std::size_t>(frame * cells + cell)] * inverse[c]);
            };
            levels.resize(levels.size() + static_cast<std::size_t>(bands + 1), notKnown);
            float *own = &levels[levels.size() - static_cast<std::size_t>(bands + 1)];
            few.clear();
            telling.clear();
            for (Index band = 0; band < bands; ++band) {
                sample.clear();
                collect(band);
                const std::ptrdiff_t count = std::ssize(sample);
                if (count < fewestCells)
                    continue;
                const float median = medianOf(sample);
                own[band] = median > 0.0f ? std::log(median) - static_cast<float>(lnMedianMean(count)) : 0.0f;
                if (2 * count >= endCell(band, bands, cells) - firstCell(band, bands, cells)) {
                    few.push_back(own[band]);
                    telling.push_back(band);
                }
            }
            float middle = 0.0f;
            if (few.size() > 2) // two cannot outvote one another: then all count
                middle = medianOf(few);
            else if (!few.empty())
                middle = std::accumulate(few.begin(), few.end(), 0.0f) / static_cast<float>(few.size());
            sample.clear();
            for (Index band : telling)
                if (telling.size() < 3 || std::abs(own[band] - middle) < agreeing)
                    collect(band);
            const float mean = truncatedMean(sample, std::exp(middle));
            own[bands] = mean > 0.0f && !sample.empty() ? std::log(mean) : 0.0f;
            std::replace(own, own + bands, notKnown, own[bands]);
        }
    }

    /// Levels tell what changes within a block. Where their median over it is far from 0, measured by their own deviation, the cells
    /// are not exponential (crowded with lines) and the row, from medians over the same frames, stands for another mean: it is taken off.
    void removeOffsets(std::vector<float> &levels, std::size_t first, Index bandCount)
    {
        const auto columns = static_cast<std::size_t>(bandCount + 1);
        const std::size_t frames = (levels.size() - first) / columns;
        std::vector<float> series(frames);
        for (std::size_t column = 0; frames > 7 && column < columns; ++column) {
            for (std::size_t frame = 0; frame < frames; ++frame)
                series[frame] = levels[first + frame * columns + column];
            const float offset = medianOf(series);
            for (float &value : series)
                value = std::abs(value - offset);
            if (std::abs(offset) < 1.4826f * medianOf(series))
                continue;
            for (std::size_t frame = 0; frame < frames; ++frame)
                levels[first + frame * columns + column] -= offset;
        }
    }

    /// Weights of linear interpolation on an axis: index of the lower neighbour and the fraction toward the next.
    struct Between {
        Index lower;
        double fraction;
    };

    Between between(const Axis &axis, double value)
    {
        const double position = std::clamp(axis.position(value), 0.0, static_cast<double>(axis.count - 1));
        const Index lower = std::min(static_cast<Index>(position), std::max<Index>(0, axis.count - 2));
        return {lower, axis.count < 2 ? 0.0 : position - static_cast<double>(lower)};
    }

    /// Between two blocks' ln powers. Between silence and noise there is nothing to interpolate: the noisy block speaks for both.
    float betweenBlocks(float early, float late, double fraction)
    {
        if (early <= silence || late <= silence)
            return std::max(early, late);
        return static_cast<float>((1.0 - fraction) * static_cast<double>(early) + fraction * static_cast<double>(late));
    }

    /// Levels over each window's own block → levels over the averaged and interpolated background.
    void moveToBackground(std::vector<float> &levels, const std::vector<float> &rows, const NoiseBackground &background,
                          double windowsPerBlock)
    {
        const Index bands = background.bandCount;
        const Index cells = background.frequency.count;
        std::vector<double> difference(static_cast<std::size_t>(cells) + 1, 0.0); // sums up to each cell
        std::vector<double> counted(difference.size(), 0.0);
        for (Index window = 0; bands > 0 && window < background.levelTime.count; ++window) {
            const auto block = std::min(static_cast<Index>(static_cast<double>(window) / windowsPerBlock), background.time.count - 1);
            const Between t = between(background.time, background.levelTime.value(static_cast<double>(window)));
            for (Index cell = 0; cell < cells; ++cell) {
                const auto at = [&](const std::vector<float> &values, Index b) {
                    return values[static_cast<std::size_t>(std::min(b, background.time.count - 1) * cells + cell)];
                };
                const float own = at(rows, block);
                const float power = betweenBlocks(at(background.lnPower, t.lower), at(background.lnPower, t.lower + 1), t.fraction);
                const bool counts = own > silence && power > silence;
                const auto c = static_cast<std::size_t>(cell);
                difference[c + 1] = difference[c] + (counts ? static_cast<double>(own - power) : 0.0);
                counted[c + 1] = counted[c] + (counts ? 1.0 : 0.0);
            }
            for (Index column = 0; column <= bands; ++column) {
                const auto from = static_cast<std::size_t>(firstCell(column, bands, cells));
                const auto to = static_cast<std::size_t>(endCell(column, bands, cells));
                if (counted[to] > counted[from])
                    levels[static_cast<std::size_t>(window * (bands + 1) + column)] +=
                        static_cast<float>((difference[to] - difference[from]) / (counted[to] - counted[from]));
            }
        }
    }

    /// From each window's levels to those that count, per sub-band: the common level's slow and sudden parts, then what a sub-band has
    /// suddenly besides.
    ///
    /// Where every window was looked at, a chance level is that of the very cells it is taken off. Where only some were, it would put
    /// noise of its own on the others, so that it has to be beyond chance.
    std::vector<float> finishLevels(const std::vector<float> &levels, const NoiseBackground &background, bool hasEveryWindow)
    {
        const double certainty = hasEveryWindow ? 2.0 : 4.5;
        const auto bands = static_cast<std::size_t>(background.bandCount);
        const auto windows = static_cast<std::size_t>(background.levelTime.count);
        std::vector<float> result(windows * bands);
        if (bands == 0)
            return result;
        const auto cells = static_cast<double>(background.frequency.count);
        std::vector<float> common(windows);
        for (std::size_t window = 0; window < windows; ++window)
            common[window] = levels[window * (bands + 1) + bands];
        const std::vector<float> slow = slowPart(common);
        for (std::size_t window = 0; window < windows; ++window)
            common[window] -= slow[window];
        common = suddenPart(common, medianScatter(cells), certainty);
        std::vector<float> own(windows);
        for (std::size_t band = 0; band < bands; ++band) {
            for (std::size_t window = 0; window < windows; ++window)
                own[window] = levels[window * (bands + 1) + band] - slow[window] - common[window];
            own = suddenPart(own, medianScatter(cells / static_cast<double>(bands)), certainty);
            for (std::size_t window = 0; window < windows; ++window)
                result[window * bands + band] = slow[window] + common[window] + own[window];
        }
        return result;
    }

    /// Between two blocks' ln powers, as `betweenBlocks`.
    FAINTLINE_MULTIVERSION
    void interpolateBlocks(const float *early, const float *late, float fraction, std::size_t cells, float *ln)
    {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const float a = early[cell];
            const float b = late[cell];
            const float least = a < b ? a : b;
            const float most = a < b ? b : a;
            const float mixed = a + fraction * (b - a);
            ln[cell] = least <= silence ? most : mixed;
        }
    }

    FAINTLINE_MULTIVERSION
    void addLine(float *values, std::int32_t count, float start, float step)
    {
        for (std::int32_t i = 0; i < count; ++i)
            values[i] += start + step * static_cast<float>(i);
    }

    /// Adds levels of sub-bands of equal width, interpolated between their middles, constant beyond the outer ones.
    void addBetweenBands(std::span<float> ln, const std::vector<float> &levels)
    {
        const double perCell = static_cast<double>(levels.size()) / static_cast<double>(ln.size());
        std::size_t cell = 0;
        for (std::size_t upper = 0; upper <= levels.size(); ++upper) { // from the middle of the band before to that of this one
            const double middle = (static_cast<double>(upper) + 0.5) / perCell - 0.5;
            std::size_t end = ln.size();
            if (upper < levels.size())
                end = std::clamp(static_cast<std::size_t>(std::ceil(middle)), cell, end);
            const double low = static_cast<double>(levels[upper == 0 ? 0 : upper - 1]);
            const double high = static_cast<double>(levels[std::min(upper, levels.size() - 1)]);
            const double slope = (high - low) * perCell;
            const double start = high + (static_cast<double>(cell) - middle) * slope;
            addLine(ln.data() + cell, static_cast<std::int32_t>(end - cell), static_cast<float>(start), static_cast<float>(slope));
            cell = end;
        }
    }

} // namespace

const std::vector<Field<NormaliserSettings>> &NormaliserSettings::fields()
{
    using S = NormaliserSettings;
    static const std::vector<Field<S>> table{
        field(&S::halfWidthCells, "halfWidthCells", "cells", 2.0, 10000.0,
              "Half the frequency window of the background estimate: wider than any line, narrower than the noise's shape."),
        field(&S::blockWindows, "blockWindows", "T_FT", 4.0, 1e6,
              "Length of a background block in windows: longer than any burst, shorter than level changes."),
        field(&S::followLevel, "followLevel",
              "Divide out sudden level changes of a whole band, such as bursts, gain steps and clicks."),
    };
    return table;
}

double NoiseBackground::lnPowerAt(double seconds, double hz) const
{
    const Between t = between(time, seconds);
    const Between f = between(frequency, hz);
    const auto value = [&](Index block, Index cell) {
        return static_cast<double>(lnPower[static_cast<std::size_t>(std::min(block, time.count - 1) * frequency.count
                                                                    + std::min(cell, frequency.count - 1))]);
    };
    const auto along = [&](Index block) {
        return value(block, f.lower) * (1.0 - f.fraction) + value(block, f.lower + 1) * f.fraction;
    };
    return along(t.lower) * (1.0 - t.fraction) + along(t.lower + 1) * t.fraction + lnUnit;
}

void NoiseBackground::readLnPower(double seconds, std::span<float> ln) const
{
    const Between t = between(time, seconds);
    const float *early = lnPower.data() + t.lower * frequency.count;
    const float *late = lnPower.data() + std::min(t.lower + 1, time.count - 1) * frequency.count;
    interpolateBlocks(early, late, static_cast<float>(t.fraction), ln.size(), ln.data());
    if (bandCount == 0)
        return;
    const Between w = between(levelTime, seconds);
    const auto level = [&](Index band) {
        const auto at = [&](Index window) {
            return static_cast<double>(lnLevel[static_cast<std::size_t>(std::min(window, levelTime.count - 1) * bandCount + band)]);
        };
        return (1.0 - w.fraction) * at(w.lower) + w.fraction * at(w.lower + 1);
    };
    std::vector<float> levels;
    for (Index band = 0; band < bandCount; ++band)
        levels.push_back(static_cast<float>(level(band)));
    if (std::any_of(levels.begin(), levels.end(), [](float value) { return value != 0.0f; }))
        addBetweenBands(ln, levels);
}

Index NoiseBackground::subBandCount(double cells)
{
    return cells < 48.0 ? 0 : static_cast<Index>(std::clamp(cells / 96.0, 1.0, 64.0));
}

std::shared_ptr<const NoiseBackground> estimateBackground(const Spectrogram &spectrogram, const NormaliserSettings &settings,
                                                          const RunContext &context, BackgroundDepth depth)
{
    const bool isSketch = depth == BackgroundDepth::Sketch;
    SpectrogramSettings coarse = spectrogram.settings();
    coarse.windowSeconds = spectrogram.windowSamples() / spectrogram.recording().info().sampleRateHz;
    coarse.stepsPerWindow = 1;
    coarse.binsPerCell = 1;
    // The band's neighbourhood belongs to the estimate: a narrow band has no noise of its own to speak of.
    SelectionSettings wide = spectrogram.selection();
    if (wide.lowHz < wide.highHz) {
        const double margin = 2.0 * settings.halfWidthCells / coarse.windowSeconds;
        wide.lowHz -= margin;
        wide.highHz += margin;
    }
    const Spectrogram frames(spectrogram.recordingPointer(), coarse, wide);

    const Index frameCount = frames.time().count;
    const Index cells = frames.frequency().count;
    const Index mostBlocks = std::clamp<Index>(largestValueCount / std::max<Index>(1, cells), 1, largestBlockCount);
    const Index framesWanted = std::max(static_cast<Index>(std::llround(settings.blockWindows)),
                                        (frameCount + mostBlocks - 1) / mostBlocks);
    const Index blockCount = isSketch ? 1 : std::max<Index>(1, frameCount / framesWanted);
    const double blockFrames = static_cast<double>(frameCount) / static_cast<double>(blockCount);

    auto background = std::make_shared<NoiseBackground>();
    const double step = blockFrames * frames.time().step;
    background->time = {"time", "s", frames.time().first + 0.5 * (blockFrames - 1.0) * frames.time().step, step, blockCount, false};
    background->frequency = frames.frequency();
    background->lnUnit = 2.0 * std::numbers::ln2 * frames.scaleExponent();
    background->lnPower.reserve(static_cast<std::size_t>(blockCount * cells));

    // Frames looked at lie on one even raster over all blocks, every frame where there are not too many of them.
    const auto mostUsed = static_cast<double>(
        isSketch ? sketchFrames : std::clamp<Index>(valuesPerBlock / std::max<Index>(1, cells), fewestFramesPerBlock, framesPerBlock));
    const Index stride = static_cast<Index>(std::ceil(blockFrames / mostUsed));
    background->levelTime = {"time", "s", frames.time().first, static_cast<double>(stride) * frames.time().step,
                             (frameCount + stride - 1) / stride, false};
    background->bandCount = settings.followLevel && !isSketch ? NoiseBackground::subBandCount(static_cast<double>(cells)) : 0;
    std::vector<float> levels;
    std::vector<float> rows;
    rows.reserve(static_cast<std::size_t>(blockCount * cells));
    std::vector<float> block;
    for (Index b = 0; b < blockCount; ++b) {
        context.checkpoint(static_cast<double>(b) / static_cast<double>(blockCount), "noise background");
        const auto first = static_cast<Index>(std::floor(static_cast<double>(b) * blockFrames));
        const auto end = std::min(frameCount, static_cast<Index>(std::floor(static_cast<double>(b + 1) * blockFrames)));
        const Index firstUsed = (first + stride - 1) / stride * stride;
        const Index used = (end - firstUsed + stride - 1) / stride;
        block.resize(static_cast<std::size_t>(used * cells));
        for (Index i = 0; i < (stride > 1 ? used : 1); ++i)
            frames.read(firstUsed + i * stride, stride > 1 ? 1 : used,
                        std::span(block).subspan(static_cast<std::size_t>(i * cells), static_cast<std::size_t>((stride > 1 ? 1 : used) * cells)));
        const BlockBackground own = blockBackground(block, cells, settings.halfWidthCells);
        rows.insert(rows.end(), own.lnPower.begin(), own.lnPower.end());
        const std::size_t firstLevel = levels.size();
        appendLevels(block, own, background->bandCount, levels);
        removeOffsets(levels, firstLevel, background->bandCount);
    }
    background->lnPower =
        averageWhileSteady(rows, blockCount, cells, settings.halfWidthCells, std::min(mostUsed, blockFrames));
    moveToBackground(levels, rows, *background, blockFrames / static_cast<double>(stride));
    background->lnLevel = finishLevels(levels, *background, stride == 1);
    return background;
}

} // namespace faintline
