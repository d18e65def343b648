#include "spectrum/NoiseBackground.h"

#include "base/fastmath.h"
#include "base/memoryShares.h"
#include "base/multiversion.h"
#include "spectrum/levels.h"
#include "spectrum/medians.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
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
    constexpr float notKnown = std::numeric_limits<float>::max();
    // Rounding of the single-precision transform, relative to the frame's strongest bin: nothing below it is noise.
    constexpr double roundingFloor = 1e-13;
    constexpr double leastNoiseRatio = 1.3; // the noise's shape itself differs from its running median by as much
    constexpr double roundingMargin = 4.0; // of ln power: what lies no higher above the floor does not tell the whole band's level
    constexpr double roundingNearness = 0.1; // nor, this near to it, its own

    /// What cells of noise, medians of so many frames, are never above in relation to their neighbours: five standard errors.
    double mostNoiseRatio(double frames)
    {
        return 1.0 + 5.0 / std::sqrt(frames);
    }

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
        std::vector<float> medians; ///< ln of each cell's mean, from its median over time
        std::vector<float> lnPower; ///< ln mean noise power
        std::vector<bool> isNoise;  ///< false where a line lies all through the block, and where there is but rounding
        std::vector<bool> isFirm;   ///< noise well above rounding
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
            return {ln, ln, std::vector<bool>(static_cast<std::size_t>(cells), true), std::vector<bool>(static_cast<std::size_t>(cells), true)};
        const auto used = static_cast<int>(std::ssize(loud) / cells);
        const double bias = std::log(medianMean(used));
        const double floor = std::log(strongest * roundingFloor);
        columnMedians(loud, ln);
        for (float &value : ln) {
            const auto power = static_cast<double>(value);
            value = static_cast<float>(std::max(floor, power > 0.0 ? std::log(power) - bias : floor));
        }
        std::vector<float> background = runningMedian(ln, half);
        std::vector<bool> isNoise = refine(ln, background, half, mostNoiseRatio(static_cast<double>(used)));
        std::vector<bool> isFirm(isNoise.size());
        for (std::size_t cell = 0; cell < background.size(); ++cell) {
            isNoise[cell] = isNoise[cell] && static_cast<double>(background[cell]) > floor + roundingNearness;
            isFirm[cell] = isNoise[cell] && static_cast<double>(background[cell]) > floor + roundingMargin;
            background[cell] = std::max(background[cell], static_cast<float>(floor));
        }
        return {std::move(ln), std::move(background), std::move(isNoise), std::move(isFirm)};
    }

    /// Brings frames (frames × cells) that are plainly louder or softer than most to one level, so that medians over time tell the noise's
    /// colour whatever its level does; answers by how much each was changed, ln. The level is the median cell's over the medians over time,
    /// of 500 cells if there are more. Digital silence is left alone.
    std::vector<float> flatten(std::vector<float> &frames, Index cells)
    {
        const Index frameCount = std::ssize(frames) / cells;
        std::vector<float> taken(static_cast<std::size_t>(frameCount), 0.0f);
        std::vector<float> loud;
        for (Index frame = 0; frame < frameCount; ++frame)
            if (const auto row = frames.begin() + frame * cells; std::any_of(row, row + cells, [](float y) { return y > 0.0f; }))
                loud.insert(loud.end(), row, row + cells);
        if (loud.empty())
            return taken;
        std::vector<float> typical(static_cast<std::size_t>(cells));
        columnMedians(loud, typical);
        const Index stride = (cells + 499) / 500;
        const double chance = 4.5 * medianScatter(static_cast<double>((cells + stride - 1) / stride));
        std::vector<float> ratios;
        for (Index frame = 0; frame < frameCount; ++frame) {
            float *row = frames.data() + frame * cells;
            ratios.clear();
            for (Index cell = 0; cell < cells; cell += stride)
                if (typical[static_cast<std::size_t>(cell)] > 0.0f)
                    ratios.push_back(row[cell] / typical[static_cast<std::size_t>(cell)]);
            if (ratios.empty())
                continue;
            const float ratio = medianOf(ratios);
            if (!(ratio > 0.0f) || std::abs(std::log(static_cast<double>(ratio))) < chance)
                continue;
            taken[static_cast<std::size_t>(frame)] = std::log(ratio);
            for (Index cell = 0; cell < cells; ++cell)
                row[cell] /= ratio;
        }
        return taken;
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

    /// out ← out + e^(values - level - about) where `counts`, which is counted.
    FAINTLINE_MULTIVERSION
    void addRatios(const float *values, float level, const float *about, const float *counts, std::size_t cells, float *sum, float *count)
    {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            sum[cell] += counts[cell] * fastExp(values[cell] - level - about[cell]);
            count[cell] += counts[cell];
        }
    }

    /// From each block's medians over time, `columns` (blocks × cells), to backgrounds, in their place: averages of blocks, smoothed over
    /// frequency.
    ///
    /// Each block is averaged with its neighbours in time as far as the noise keeps its colour: stationary noise is known better than one
    /// block tells. What the whole band's level does meanwhile is taken out; a step of more than a factor of e ends the average, and so
    /// does, for each cell, more than four standard errors of a difference of two blocks' `rows` (smoothed one by one), which are a median's
    /// of `framesUsed` × window cells, and of fewer toward the band's edges, where the window is continued from a few of them.
    /// Cells are averaged before they are smoothed, for a running median of cells that scatter errs where a slope begins. A block's lines
    /// do not count, so that a line that moves slowly raises none of the cells it has been in.
    void averageWhileSteady(std::vector<float> &columns, const std::vector<float> &rows, Index cells, Index half, double framesUsed)
    {
        constexpr Index reach = 6;
        const Index blocks = std::ssize(rows) / std::max<Index>(1, cells);
        std::vector<float> tolerance(static_cast<std::size_t>(cells));
        for (Index cell = 0; cell < cells; ++cell) {
            const double inward = static_cast<double>(std::min({cell, cells - 1 - cell, half})) / static_cast<double>(half);
            const double effective = pivotCells + (2.0 * static_cast<double>(half) + 1.0 - pivotCells) * inward;
            tolerance[static_cast<std::size_t>(cell)] = static_cast<float>(4.0 * 1.44 * std::sqrt(2.0 / (framesUsed * effective / 2.0)));
        }
        const double mostRatio = mostNoiseRatio(framesUsed);
        const auto lnMost = static_cast<float>(std::log(mostRatio));
        std::vector<float> sum(tolerance.size());
        std::vector<float> count(tolerance.size());
        std::vector<float> counts(tolerance.size());
        std::vector<char> goesOn(tolerance.size());
        std::deque<std::vector<float>> finished; // the last blocks, whose own medians are still asked for
        for (Index block = 0; block < blocks; ++block) {
            const float *own = rows.data() + block * cells;
            std::fill(sum.begin(), sum.end(), 0.0f);
            std::fill(count.begin(), count.end(), 0.0f);
            const auto add = [&](Index other, float level) {
                const float *values = columns.data() + other * cells;
                const float *smooth = rows.data() + other * cells;
                for (std::size_t cell = 0; cell < counts.size(); ++cell)
                    counts[cell] = goesOn[cell] && std::abs(values[cell] - smooth[cell]) < lnMost ? 1.0f : 0.0f;
                addRatios(values, level, own, counts.data(), counts.size(), sum.data(), count.data());
            };
            std::fill(goesOn.begin(), goesOn.end(), 1);
            add(block, 0.0f);
            double blocksAveraged = 1.0;
            for (Index direction : {-1, 1}) {
                std::fill(goesOn.begin(), goesOn.end(), 1);
                for (Index i = 1; i <= reach; ++i) {
                    const Index other = block + direction * i;
                    if (other < 0 || other >= blocks)
                        break;
                    const float *smooth = rows.data() + other * cells;
                    const float level = levelBetween(smooth, own, cells, framesUsed);
                    if (std::abs(level) > 1.0f)
                        break;
                    for (std::size_t cell = 0; cell < tolerance.size(); ++cell)
                        goesOn[cell] = goesOn[cell] && std::abs(smooth[cell] - level - own[cell]) <= tolerance[cell];
                    add(other, level);
                    blocksAveraged += 1.0;
                }
            }
            std::vector<float> column(tolerance.size());
            const float *medians = columns.data() + block * cells;
            for (std::size_t cell = 0; cell < column.size(); ++cell)
                column[cell] = count[cell] > 0.0f ? own[cell] + std::log(sum[cell] / count[cell]) : medians[cell];
            std::vector<float> background = runningMedian(column, half);
            refine(column, background, half, std::max(leastNoiseRatio, mostNoiseRatio(framesUsed * blocksAveraged)));
            const float least = *std::min_element(own, own + cells); // the floor of rounding
            for (float &value : background)
                value = std::max(value, least);
            finished.push_back(std::move(background));
            if (std::ssize(finished) > reach) {
                std::copy(finished.front().begin(), finished.front().end(), columns.begin() + (block - reach) * cells);
                finished.pop_front();
            }
        }
        for (Index block = blocks - std::ssize(finished); block < blocks; ++block) {
            std::copy(finished.front().begin(), finished.front().end(), columns.begin() + block * cells);
            finished.pop_front();
        }
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

    /// ln of the mean of which a mean of so many cells is an estimate: what the logarithm of one that scatters falls short by is added.
    float lnMean(float mean, std::ptrdiff_t cells, double likeness)
    {
        const double scatter = meanScatter(static_cast<double>(cells), likeness);
        return std::log(mean) + static_cast<float>(0.5 * scatter * scatter);
    }

    /// ln of each frame's level over its block's background, frames × (bands + 1): per sub-band the mean of its cells of noise, then the whole
    /// band's common one, from the sub-bands that agree with the median sub-band. `notKnown` in digital silence. Sub-bands that are mostly
    /// lines or empty have no say in what is common, and go with it where nothing of them is noise.
    std::vector<float> levelsOf(std::span<const float> frames, const BlockBackground &block, Index bands, double likeness)
    {
        std::vector<float> levels;
        if (bands == 0)
            return levels;
        constexpr std::ptrdiff_t fewestCells = 24;
        const Index cells = std::ssize(block.lnPower);
        std::vector<float> inverse(static_cast<std::size_t>(cells));
        for (std::size_t cell = 0; cell < inverse.size(); ++cell)
            inverse[cell] = block.lnPower[cell] > silence ? std::exp(-block.lnPower[cell]) : 0.0f;
        const auto agreeing = static_cast<float>(4.0 * medianScatter(static_cast<double>(cells) / static_cast<double>(bands)));
        std::vector<float> sample;
        std::vector<float> few;
        std::vector<Index> telling;
        std::vector<Index> known;
        for (Index frame = 0; frame < std::ssize(frames) / cells; ++frame) {
            const auto collect = [&](Index band, const std::vector<bool> &wanted) {
                for (Index cell = firstCell(band, bands, cells); cell < endCell(band, bands, cells); ++cell)
                    if (const auto c = static_cast<std::size_t>(cell); wanted[c])
                        sample.push_back(frames[static_cast<std::size_t>(frame * cells + cell)] * inverse[c]);
            };
            levels.resize(levels.size() + static_cast<std::size_t>(bands + 1), notKnown);
            float *own = &levels[levels.size() - static_cast<std::size_t>(bands + 1)];
            few.clear();
            telling.clear();
            known.clear();
            for (Index band = 0; band < bands; ++band) {
                sample.clear();
                collect(band, block.isNoise);
                const std::ptrdiff_t count = std::ssize(sample);
                if (count < fewestCells)
                    continue;
                const float median = medianOf(sample);
                if (!(median > 0.0f))
                    continue;
                own[band] = lnMean(truncatedMean(sample, median / std::numbers::ln2_v<float>), count, likeness);
                known.push_back(band);
                const auto firm = std::count(block.isFirm.begin() + firstCell(band, bands, cells), block.isFirm.begin() + endCell(band, bands, cells), true);
                if (2 * firm >= endCell(band, bands, cells) - firstCell(band, bands, cells)) {
                    few.push_back(own[band]);
                    telling.push_back(band);
                }
            }
            const bool isFirm = 2 * std::ssize(telling) >= bands || known.size() == telling.size();
            if (!isFirm) { // a few sub-bands are not the whole
                telling = known;
                few.clear();
                for (const Index band : known)
                    few.push_back(own[band]);
            }
            float middle = 0.0f;
            if (few.size() > 2) // two cannot outvote one another: then all count
                middle = medianOf(few);
            else if (!few.empty())
                middle = std::accumulate(few.begin(), few.end(), 0.0f) / static_cast<float>(few.size());
            sample.clear();
            for (Index band : telling)
                if (telling.size() < 3 || std::abs(own[band] - middle) < agreeing)
                    collect(band, isFirm ? block.isFirm : block.isNoise);
            const float mean = truncatedMean(sample, std::exp(middle));
            own[bands] = mean > 0.0f && !sample.empty() ? lnMean(mean, std::ssize(sample), likeness) : notKnown;
            std::replace(own, own + bands, notKnown, own[bands]);
        }
        return levels;
    }

    /// Medians over the frames of each column of levels.
    std::vector<float> mediansOf(const std::vector<float> &levels, Index columns)
    {
        std::vector<float> medians(static_cast<std::size_t>(columns), 0.0f);
        std::vector<float> series;
        for (std::size_t column = 0; column < medians.size(); ++column) {
            series.clear();
            for (std::size_t i = column; i < levels.size(); i += medians.size())
                if (levels[i] < notKnown)
                    series.push_back(levels[i]);
            if (!series.empty())
                medians[column] = medianOf(series);
        }
        return medians;
    }

    /// What a block's levels are too high by, column by column. Levels tell what changes within a block: their median over it is 0, but for
    /// the skirts of lines, which means over cells hold more of than the row, from medians over time, does.
    struct Offsets {
        std::vector<float> medians;
        std::vector<bool> isSure; ///< beyond their own deviation: the cells are not exponential (crowded with lines)

        Offsets(const std::vector<float> &levels, Index columns) : medians(mediansOf(levels, columns)), isSure(medians.size(), false)
        {
            std::vector<float> deviations = levels;
            for (std::size_t i = 0; i < levels.size(); ++i)
                if (levels[i] < notKnown)
                    deviations[i] = std::abs(levels[i] - medians[i % medians.size()]);
            const std::vector<float> typical = mediansOf(deviations, columns);
            for (std::size_t column = 0; column < medians.size(); ++column)
                isSure[column] = std::ssize(levels) > 7 * columns && std::abs(medians[column]) >= 1.4826f * typical[column];
        }
    };

    /// As much of a sub-band's median level over a long time as lines may make, and chance hardly does.
    float shareOfLines(float median)
    {
        constexpr float chance = 0.02f;
        constexpr float most = 0.15f;
        return std::clamp(median - chance, 0.0f, most);
    }

    /// Takes offsets off levels: the sure ones of each block, else those of sub-bands over a dozen blocks, as far as lines may make them.
    void removeOffsets(std::vector<float> &levels, const std::vector<Offsets> &offsets, const std::vector<Index> &blockOfLevel)
    {
        constexpr Index reach = 6;
        if (offsets.empty())
            return;
        const std::size_t columns = offsets.front().medians.size();
        std::vector<std::vector<float>> taken;
        std::vector<float> few;
        for (Index block = 0; block < std::ssize(offsets); ++block) {
            const Offsets &own = offsets[static_cast<std::size_t>(block)];
            taken.push_back(std::vector<float>(columns, 0.0f));
            for (std::size_t column = 0; column < columns; ++column) {
                if (own.isSure[column]) {
                    taken.back()[column] = own.medians[column];
                    continue;
                }
                if (column + 1 == columns)
                    continue;
                few.clear();
                for (Index other = std::max<Index>(0, block - reach); other <= std::min(std::ssize(offsets) - 1, block + reach); ++other)
                    if (const Offsets &each = offsets[static_cast<std::size_t>(other)]; !each.isSure[column])
                        few.push_back(each.medians[column]);
                taken.back()[column] = shareOfLines(medianOf(few));
            }
        }
        for (std::size_t i = 0; i < levels.size(); ++i)
            if (levels[i] < notKnown)
                levels[i] -= taken[static_cast<std::size_t>(blockOfLevel[i / columns])][i % columns];
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

    /// What the blocks were measured with, one by one: ln powers smoothed over frequency, and which cells are noise (blocks × cells).
    struct BlockRows {
        std::vector<float> lnPower;
        std::vector<bool> isNoise;
    };

    /// Mean of one row over another, of the cells of noise in each sub-band and in the whole band, ln.
    std::vector<double> between(const float *upper, const float *lower, std::vector<bool>::const_iterator isNoise, Index cells, Index bands)
    {
        std::vector<double> result(static_cast<std::size_t>(bands + 1), 0.0);
        std::vector<double> counts(result.size(), 0.0);
        for (Index band = 0; band < bands; ++band)
            for (Index cell = firstCell(band, bands, cells); cell < endCell(band, bands, cells); ++cell)
                if (isNoise[cell]) {
                    result[static_cast<std::size_t>(band)] += static_cast<double>(upper[cell] - lower[cell]);
                    counts[static_cast<std::size_t>(band)] += 1.0;
                }
        result.back() = std::accumulate(result.begin(), result.end(), 0.0);
        counts.back() = std::accumulate(counts.begin(), counts.end(), 0.0);
        for (std::size_t column = 0; column < result.size(); ++column)
            result[column] = counts[column] > 0.0 ? result[column] / counts[column] : 0.0;
        for (std::size_t column = 0; column < result.size(); ++column)
            if (counts[column] == 0.0) // its level is the common one
                result[column] = result.back();
        return result;
    }

    /// Levels over each window's own block, whose row they were measured with, → levels over the averaged and interpolated background.
    void moveToBackground(std::vector<float> &levels, const BlockRows &rows, const NoiseBackground &background,
                          const std::vector<Index> &blockOfLevel)
    {
        const Index columns = background.bandCount + 1;
        const Index cells = background.frequency.count;
        const Index last = background.time.count - 1;
        std::array<std::vector<double>, 3> over; // the block before, its own, the next
        Index known = -1;
        for (Index i = 0; i < background.levelTime.count; ++i) {
            const Index block = blockOfLevel[static_cast<std::size_t>(i)];
            const float *own = rows.lnPower.data() + block * cells;
            if (block != known)
                for (Index side = -1; side <= 1; ++side)
                    over[static_cast<std::size_t>(side + 1)] =
                        between(own, background.lnPower.data() + std::clamp<Index>(block + side, 0, last) * cells,
                                rows.isNoise.begin() + block * cells, cells, background.bandCount);
            known = block;
            if (own[0] <= silence)
                continue;
            const Between t = between(background.time, background.levelTime.value(static_cast<double>(i)));
            const auto isSilent = [&](Index b) { return background.lnPower[static_cast<std::size_t>(std::min(b, last) * cells)] <= silence; };
            const Index early = isSilent(t.lower) ? t.lower + 1 : t.lower;
            const Index late = isSilent(t.lower + 1) ? t.lower : t.lower + 1;
            for (Index column = 0; column < columns; ++column) {
                const auto difference = [&](Index b) {
                    return over[static_cast<std::size_t>(std::clamp<Index>(std::min(b, last) - block + 1, 0, 2))][static_cast<std::size_t>(column)];
                };
                float &level = levels[static_cast<std::size_t>(i * columns + column)];
                if (level < notKnown)
                    level += static_cast<float>((1.0 - t.fraction) * difference(early) + t.fraction * difference(late));
            }
        }
    }

    /// Gives silence the level of what was before it, or of what comes first.
    void bridgeSilence(std::vector<float> &series)
    {
        const auto first = std::find_if(series.begin(), series.end(), [](float value) { return value < notKnown; });
        float level = first == series.end() ? 0.0f : *first;
        for (float &value : series)
            level = value = value < notKnown ? value : level;
    }

    /// From the levels measured to those that count, per sub-band: what the common level does beyond its errors, then what a sub-band
    /// does besides.
    std::vector<float> finishLevels(const std::vector<float> &levels, const NoiseBackground &background, double overlap, double likeness)
    {
        const auto bands = static_cast<std::size_t>(background.bandCount);
        const auto count = static_cast<std::size_t>(background.levelTime.count);
        std::vector<float> result(count * bands);
        if (bands == 0)
            return result;
        const auto cells = static_cast<double>(background.frequency.count);
        const auto column = [&](std::size_t number) {
            std::vector<float> series(count);
            for (std::size_t i = 0; i < count; ++i)
                series[i] = levels[i * (bands + 1) + number];
            bridgeSilence(series);
            return series;
        };
        const std::vector<float> common = beyondScatter(column(bands), overlap * meanScatter(cells, likeness));
        for (std::size_t band = 0; band < bands; ++band) {
            std::vector<float> own = column(band);
            for (std::size_t i = 0; i < count; ++i)
                own[i] -= common[i];
            own = beyondScatter(own, overlap * meanScatter(cells / static_cast<double>(bands), likeness));
            for (std::size_t i = 0; i < count; ++i)
                result[i * bands + band] = common[i] + own[i];
        }
        return result;
    }

    /// Between two blocks' ln powers. Between silence and noise there is nothing to interpolate: the noisy block speaks for both.
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

    /// Adds levels of sub-bands of equal width, interpolated between their middles, constant beyond the outer ones. Between middles that
    /// lie an abyss apart, such as a receiver's band and the emptiness beside it, it is different noise, and changes half-way down.
    void addBetweenBands(std::span<float> ln, const std::vector<float> &levels)
    {
        constexpr float abyss = 4.6f; // 20 dB
        const double perCell = static_cast<double>(levels.size()) / static_cast<double>(ln.size());
        const auto middleOf = [&](std::size_t band) { return (static_cast<double>(band) + 0.5) / perCell - 0.5; };
        const auto place = [&](double cell) { return std::min(static_cast<std::size_t>(std::ceil(std::max(0.0, cell))), ln.size()); };
        const auto addConstant = [&](std::size_t from, std::size_t to, float level) {
            addLine(ln.data() + from, static_cast<std::int32_t>(to - from), level, 0.0f);
        };
        addConstant(0, place(middleOf(0)), levels.front());
        for (std::size_t band = 0; band + 1 < levels.size(); ++band) { // from its middle to that of the next
            const std::size_t from = place(middleOf(band));
            const std::size_t to = place(middleOf(band + 1));
            if (from >= to)
                continue;
            const float start = ln[from];
            const float fall = ln[to - 1] - start;
            if (std::abs(fall) > abyss) {
                const auto half = std::find_if(ln.begin() + static_cast<std::ptrdiff_t>(from), ln.begin() + static_cast<std::ptrdiff_t>(to),
                                               [&](float value) { return (value - start) / fall > 0.5f; });
                const auto edge = static_cast<std::size_t>(half - ln.begin());
                addConstant(from, edge, levels[band]);
                addConstant(edge, to, levels[band + 1]);
                continue;
            }
            const double slope = static_cast<double>(levels[band + 1] - levels[band]) * perCell;
            const double first = static_cast<double>(levels[band]) + (static_cast<double>(from) - middleOf(band)) * slope;
            addLine(ln.data() + from, static_cast<std::int32_t>(to - from), static_cast<float>(first), static_cast<float>(slope));
        }
        const std::size_t last = place(middleOf(levels.size() - 1));
        addConstant(last, ln.size(), levels.back());
    }

    /// The frames between two windows that the detector looks at besides, up to three: spectra of windows that begin a hop later each.
    std::vector<Spectrogram> betweenWindows(const Spectrogram &detector, const Spectrogram &windows)
    {
        constexpr Index most = 4;
        std::vector<Spectrogram> result;
        const Index steps = std::min<Index>(detector.settings().stepsPerWindow, most);
        const double rate = detector.recording().info().sampleRateHz;
        for (Index shift = 1; shift < steps; ++shift) {
            SelectionSettings later = windows.selection();
            later.fromSeconds += std::round(static_cast<double>(shift * windows.windowSamples()) / static_cast<double>(steps)) / rate;
            if (detector.time().count <= detector.settings().stepsPerWindow)
                return {}; // hardly longer than a window
            result.emplace_back(windows.recordingPointer(), windows.settings(), later);
        }
        return result;
    }

    /// How much tiles of 8 frames × 24 cells change with time.
    struct Unevenness {
        double sum = 0.0;      ///< of squared deviations of ln(mean of a tile) from its cells' mean over all time
        double sumOfMeans = 0.0; ///< of the means' themselves, which a few tiles far too high decide
        double freedom = 0.0;  ///< how many of them are independent

        double variance() const { return freedom > 0.0 ? sum / freedom : 0.0; }
        double varianceOfMeans() const { return freedom > 0.0 ? sumOfMeans / freedom : 0.0; }
        /// That of steady noise, whose neighbouring cells are alike by the window.
        static double ofNoise(double likeness) { return likeness / static_cast<double>(tileFrames * tileCells); }

        static constexpr Index tileFrames = 8;
        static constexpr Index tileCells = 24;
    };

    /// Of frames (frames × cells) times a factor for each cell and one for each frame; strong lines cut off.
    Unevenness unevenness(std::span<const float> frames, const std::vector<float> &ofCell, const std::vector<float> &ofFrame)
    {
        constexpr float most = 5.0f;
        const Index cells = std::ssize(ofCell);
        Unevenness result;
        for (Index cell = 0; cell + Unevenness::tileCells <= cells; cell += Unevenness::tileCells) {
            double sum = 0.0;
            double squares = 0.0;
            double sumOfMeans = 0.0;
            double squaresOfMeans = 0.0;
            double count = 0.0;
            for (Index first = 0; first + Unevenness::tileFrames <= std::ssize(ofFrame); first += Unevenness::tileFrames) {
                double mean = 0.0;
                for (Index frame = first; frame < first + Unevenness::tileFrames; ++frame) {
                    const float *row = frames.data() + frame * cells;
                    const float factor = ofFrame[static_cast<std::size_t>(frame)];
                    for (Index i = cell; i < cell + Unevenness::tileCells; ++i)
                        mean += static_cast<double>(std::min(row[i] * factor * ofCell[static_cast<std::size_t>(i)], most));
                }
                if (mean <= 0.0)
                    continue;
                mean /= static_cast<double>(Unevenness::tileFrames * Unevenness::tileCells);
                const double ln = std::log(mean);
                sum += ln;
                squares += ln * ln;
                sumOfMeans += mean;
                squaresOfMeans += mean * mean;
                count += 1.0;
            }
            if (count < 2.0)
                continue;
            result.sum += squares - sum * sum / count;
            result.sumOfMeans += squaresOfMeans - sumOfMeans * sumOfMeans / count;
            result.freedom += count - 1.0;
        }
        return result;
    }

    /// How the colour changes in a block: of its frames over its row and the common level.
    Unevenness changesOf(const std::vector<float> &frames, const BlockBackground &block, const std::vector<float> &levels, Index bands)
    {
        std::vector<float> ofCell;
        for (const float ln : block.lnPower)
            ofCell.push_back(ln > silence ? std::exp(-ln) : 0.0f);
        std::vector<float> ofFrame;
        for (std::size_t i = static_cast<std::size_t>(bands); i < levels.size(); i += static_cast<std::size_t>(bands + 1))
            ofFrame.push_back(levels[i] < notKnown ? std::exp(-levels[i]) : 0.0f);
        return unevenness(frames, ofCell, ofFrame);
    }

    /// frames ← frames·e^(-ln)
    void divide(std::span<float> frame, std::span<const float> ln)
    {
        for (std::size_t cell = 0; cell < frame.size(); ++cell)
            frame[cell] *= std::exp(-ln[cell]);
    }

    /// ln power of a stretch's noise in a frame with these levels of its sources.
    void readStretch(const NoiseStretch &stretch, std::span<const float> levels, std::span<float> ln)
    {
        stretch.sources.addUp(levels, ln);
        for (std::size_t cell = 0; cell < ln.size(); ++cell)
            ln[cell] = std::max(stretch.floor, stretch.lnPower[cell] + fastLn(std::max(ln[cell], 1e-30f)));
    }

    /// Frames of a stretch of time, as the detector sees them: windows from `first` on, `shift` hops later each.
    struct StretchFrames {
        Index first;
        Index count;
        Index steps;
        const Spectrogram &windows;
        const std::vector<Spectrogram> &shifted;

        std::vector<float> read(Index shift, Index cells) const
        {
            const Spectrogram &source = shift == 0 ? windows : shifted[static_cast<std::size_t>(shift - 1)];
            const Index there = std::max<Index>(0, std::min(count, source.time().count - first));
            std::vector<float> frames(static_cast<std::size_t>(there * cells));
            if (there > 0)
                source.read(first, there, frames);
            return frames;
        }
    };

    /// Where a stretch's noise is a sum of sources, adds them to the background and replaces its levels by those over them.
    void addStretch(NoiseBackground &background, const StretchFrames &stretchFrames, Index half, double likeness, std::vector<float> &levels)
    {
        constexpr Index cellsForThree = 144;
        constexpr double better = 1.1;
        constexpr double explained = 1.3;
        const Index cells = background.frequency.count;
        const double expected = Unevenness::ofNoise(likeness);
        std::vector<float> frames = stretchFrames.read(0, cells);
        const float strongest = *std::max_element(frames.begin(), frames.end());
        const Between t = between(background.time, background.levelTime.value(static_cast<double>((stretchFrames.first + stretchFrames.count / 2) * stretchFrames.steps)));
        const auto row = background.lnPower.begin() + t.lower * cells;
        if (!(strongest > 0.0f) || *row <= silence)
            return;
        NoiseStretch stretch;
        stretch.firstLevel = stretchFrames.first * stretchFrames.steps;
        stretch.lnPower.assign(row, row + cells);
        stretch.floor = std::log(strongest) + static_cast<float>(std::log(roundingFloor));
        const auto frameOf = [&](std::vector<float> &all, Index frame) {
            return std::span(all).subspan(static_cast<std::size_t>(frame * cells), static_cast<std::size_t>(cells));
        };
        std::vector<float> ln(static_cast<std::size_t>(cells));
        std::vector<float> before = frames;
        for (Index frame = 0; frame < stretchFrames.count; ++frame) {
            background.readLnPower(background.levelTime.value(static_cast<double>((stretchFrames.first + frame) * stretchFrames.steps)), ln);
            divide(frameOf(before, frame), ln);
            divide(frameOf(frames, frame), stretch.lnPower);
        }
        const std::vector<float> asTheyAre(static_cast<std::size_t>(cells), 1.0f);
        const std::vector<float> each(static_cast<std::size_t>(stretchFrames.count), 1.0f);
        const Unevenness unevennessBefore = unevenness(before, asTheyAre, each);
        before = {};
        stretch.sources = fitSources(frames, cells, cells < cellsForThree ? 2 : 3, half);
        if (stretch.sources.count() == 0)
            return;
        const Index sources = stretch.sources.count();
        stretch.sourceLevels.assign(static_cast<std::size_t>(stretchFrames.count * stretchFrames.steps * sources), 0.0f);
        const auto divideByNoise = [&](std::vector<float> &all, Index shift) { // which is there already divided by lnPower
            for (Index frame = 0; frame < std::ssize(all) / cells; ++frame) {
                const auto values = frameOf(all, frame);
                const std::vector<float> own = stretch.sources.levelsIn(values);
                std::copy(own.begin(), own.end(), stretch.sourceLevels.begin() + (frame * stretchFrames.steps + shift) * sources);
                readStretch(stretch, own, ln);
                for (std::size_t cell = 0; cell < ln.size(); ++cell)
                    values[cell] *= std::exp(stretch.lnPower[cell] - ln[cell]);
            }
        };
        divideByNoise(frames, 0);
        BlockBackground rest = blockBackground(frames, cells, half);
        for (Index frame = 0; frame < stretchFrames.count; ++frame)
            divide(frameOf(frames, frame), rest.lnPower);
        // Signals change with time, too, and are no sources of noise: nothing but chance may be left.
        const Unevenness unevennessAfter = unevenness(frames, asTheyAre, each);
        const bool isBetter = unevennessBefore.variance() > better * unevennessAfter.variance()
                              || unevennessBefore.varianceOfMeans() > better * unevennessAfter.varianceOfMeans();
        if (!isBetter || unevennessAfter.variance() > explained * expected)
            return;
        for (std::size_t cell = 0; cell < stretch.lnPower.size(); ++cell)
            stretch.lnPower[cell] += rest.lnPower[cell];
        std::fill(rest.lnPower.begin(), rest.lnPower.end(), 0.0f);
        const Index columns = background.bandCount + 1;
        std::vector<float> offsets;
        for (Index shift = 0; shift < stretchFrames.steps; ++shift) {
            if (shift > 0) {
                frames = stretchFrames.read(shift, cells);
                for (Index frame = 0; frame < std::ssize(frames) / cells; ++frame)
                    divide(frameOf(frames, frame), stretch.lnPower);
                divideByNoise(frames, shift);
            }
            const std::vector<float> own = levelsOf(frames, rest, background.bandCount, likeness);
            if (shift == 0)
                offsets = mediansOf(own, columns);
            for (Index i = 0; i < std::ssize(own); ++i) {
                const Index place = (stretchFrames.first + i / columns) * stretchFrames.steps + shift;
                const float level = own[static_cast<std::size_t>(i)];
                levels[static_cast<std::size_t>(place * columns + i % columns)] =
                    level < notKnown ? level - shareOfLines(offsets[static_cast<std::size_t>(i % columns)]) : notKnown;
            }
        }
        background.stretches.push_back(std::move(stretch));
    }

    /// By how much the scatter of a mean over many successive frames exceeds that over as many independent ones.
    double overlapFactor(const Spectrogram &windows, Index steps)
    {
        const std::vector<float> window = sampleWindow(windows.settings().window, windows.windowSamples());
        double likenesses = 1.0;
        for (Index shift = 1; shift < steps; ++shift) {
            const Index lag = shift * windows.windowSamples() / steps;
            const double product = std::inner_product(window.begin() + lag, window.end(), window.begin(), 0.0);
            likenesses += 2.0 * product * product;
        }
        return std::sqrt(likenesses);
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
    const Between w = between(levelTime, seconds);
    const auto stretch = std::find_if(stretches.begin(), stretches.end(), [&](const NoiseStretch &each) {
        return w.lower >= each.firstLevel && w.lower < each.firstLevel + each.levelCount();
    });
    if (stretch != stretches.end()) {
        const auto sources = static_cast<std::size_t>(stretch->sources.count());
        const auto levelsAt = [&](Index i) {
            return stretch->sourceLevels.data() + (std::min(i, stretch->firstLevel + stretch->levelCount() - 1) - stretch->firstLevel) * stretch->sources.count();
        };
        std::vector<float> levels(sources);
        for (std::size_t k = 0; k < sources; ++k)
            levels[k] = levelsAt(w.lower)[k] + static_cast<float>(w.fraction) * (levelsAt(w.lower + 1)[k] - levelsAt(w.lower)[k]);
        readStretch(*stretch, levels, ln);
    } else {
        const Between t = between(time, seconds);
        const float *early = lnPower.data() + t.lower * frequency.count;
        const float *late = lnPower.data() + std::min(t.lower + 1, time.count - 1) * frequency.count;
        interpolateBlocks(early, late, static_cast<float>(t.fraction), ln.size(), ln.data());
    }
    if (bandCount == 0)
        return;
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
    const double likeness = cellLikeness(sampleWindow(coarse.window, frames.windowSamples()));

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

    // Frames looked at lie on one even raster over all blocks, every frame where there are not too many of them.
    const auto mostUsed = static_cast<double>(
        isSketch ? sketchFrames : std::clamp<Index>(valuesPerBlock / std::max<Index>(1, cells), fewestFramesPerBlock, framesPerBlock));
    const Index stride = static_cast<Index>(std::ceil(blockFrames / mostUsed));
    background->bandCount = settings.followLevel && !isSketch ? NoiseBackground::subBandCount(static_cast<double>(cells)) : 0;
    // Levels are those of the detector's own frames, which overlap: in between a sudden change would have to be guessed.
    const std::vector<Spectrogram> shifted = stride == 1 && background->bandCount > 0 ? betweenWindows(spectrogram, frames) : std::vector<Spectrogram>{};
    const Index steps = std::ssize(shifted) + 1;
    background->levelTime = {"time", "s", frames.time().first, static_cast<double>(stride) * frames.time().step / static_cast<double>(steps),
                             (frameCount + stride - 1) / stride * steps, false};
    const Index columns = background->bandCount + 1;
    std::vector<float> levels(background->bandCount > 0 ? static_cast<std::size_t>(background->levelTime.count * columns) : 0, notKnown);
    std::vector<Index> blockOfLevel(static_cast<std::size_t>(background->levelTime.count), blockCount - 1);
    BlockRows rows;
    rows.lnPower.reserve(static_cast<std::size_t>(blockCount * cells));
    background->lnPower.reserve(static_cast<std::size_t>(blockCount * cells));
    std::vector<Unevenness> changes; // of each block
    std::vector<Offsets> offsets;
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
        const std::vector<float> taken =
            background->bandCount > 0 ? flatten(block, cells) : std::vector<float>(static_cast<std::size_t>(used), 0.0f);
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
                if (const float level = source[static_cast<std::size_t>(row * columns + column)]; level < notKnown)
                    levels[static_cast<std::size_t>(place * columns + column)] = level + more;
        };
        std::fill_n(blockOfLevel.begin() + firstUsed / stride * steps, used * steps, b);
        for (Index i = 0; i < used; ++i)
            put(measured, i, (firstUsed / stride + i) * steps, taken[static_cast<std::size_t>(i)]);
        for (Index shift = 1; shift < steps; ++shift) {
            const Spectrogram &other = shifted[static_cast<std::size_t>(shift - 1)];
            const Index there = std::min(used, other.time().count - first);
            if (there <= 0)
                continue;
            const auto values = std::span(block).first(static_cast<std::size_t>(there * cells));
            other.read(first, there, values);
            const std::vector<float> more = levelsOf(values, own, background->bandCount, likeness);
            for (Index i = 0; i < there; ++i)
                put(more, i, (first + i) * steps + shift, 0.0f);
        }
    }
    averageWhileSteady(background->lnPower, rows.lnPower, cells, settings.halfWidthCells, std::min(mostUsed, blockFrames));
    if (background->bandCount > 0) {
        removeOffsets(levels, offsets, blockOfLevel);
        moveToBackground(levels, rows, *background, blockOfLevel);
    }
    const double overlap = overlapFactor(frames, steps);
    background->lnLevel = finishLevels(levels, *background, overlap, likeness);
    if (background->bandCount == 0 || stride > 1)
        return background;
    constexpr Index stretchBlocks = 13;
    constexpr double noticeable = 1.5;
    const double expected = Unevenness::ofNoise(likeness);
    const Index together = std::clamp<Index>(static_cast<Index>(static_cast<double>(valuesPerBlock / cells) / blockFrames), 1, stretchBlocks);
    for (Index b = 0; b < blockCount; b += together) {
        const auto first = static_cast<Index>(std::floor(static_cast<double>(b) * blockFrames));
        const Index end = b + together < blockCount ? static_cast<Index>(std::floor(static_cast<double>(b + together) * blockFrames)) : frameCount;
        Unevenness change;
        for (Index each = b; each < std::min(blockCount, b + together); ++each) {
            change.sum += changes[static_cast<std::size_t>(each)].sum;
            change.freedom += changes[static_cast<std::size_t>(each)].freedom;
        }
        if (change.variance() > noticeable * expected)
            addStretch(*background, {first, end - first, steps, frames, shifted}, settings.halfWidthCells, likeness, levels);
    }
    if (!background->stretches.empty())
        background->lnLevel = finishLevels(levels, *background, overlap, likeness);
    return background;
}

} // namespace faintline
