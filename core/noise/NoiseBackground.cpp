#include "noise/NoiseBackground.h"

#include "base/fastmath.h"
#include "base/multiversion.h"
#include "noise/between.h"
#include "noise/constants.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace faintline {

namespace {

    /// Interpolates ln powers between two blocks. Between silence and noise the noisy block is used for both.
    FAINTLINE_MULTIVERSION
    void interpolateBlocks(const float *early, const float *late, float fraction, std::size_t cells, float *ln)
    {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const float a = early[cell];
            const float b = late[cell];
            const float least = a < b ? a : b;
            const float most = a < b ? b : a;
            const float mixed = a + fraction * (b - a);
            ln[cell] = least <= NoiseBackground::silence ? most : mixed;
        }
    }

    FAINTLINE_MULTIVERSION
    void addLine(float *values, std::int32_t count, float start, float step)
    {
        for (std::int32_t i = 0; i < count; ++i)
            values[i] += start + step * float(i);
    }

    /// Adds levels of sub-bands of equal width, interpolated between their middles and constant beyond the outer ones.
    /// If adjacent levels differ extremely, as at the edge of a receiver's band, the noise is different on both sides,
    /// and the level changes abruptly half-way.
    void addBetweenBands(std::span<float> ln, const std::vector<float> &levels)
    {
        const double perCell = double(levels.size()) / double(ln.size());
        const auto middleOf = [&](std::size_t band) { return (double(band) + 0.5) / perCell - 0.5; };
        const auto place = [&](double cell) {
            return std::min(std::size_t(std::ceil(std::max(0.0, cell))), ln.size());
        };
        const auto addConstant = [&](std::size_t from, std::size_t to, float level) {
            addLine(ln.data() + from, std::int32_t(to - from), level, 0.0f);
        };
        addConstant(0, place(middleOf(0)), levels.front());
        for (std::size_t band = 0; band + 1 < levels.size(); ++band) { // from its middle to that of the next
            const std::size_t from = place(middleOf(band));
            const std::size_t to = place(middleOf(band + 1));
            if (from >= to)
                continue;
            const float start = ln[from];
            const float fall = ln[to - 1] - start;
            if (std::abs(fall) > abruptLevelLn) {
                const auto half = std::find_if(ln.begin() + std::ptrdiff_t(from), ln.begin() + std::ptrdiff_t(to),
                                               [&](float value) { return (value - start) / fall > 0.5f; });
                const auto edge = std::size_t(half - ln.begin());
                addConstant(from, edge, levels[band]);
                addConstant(edge, to, levels[band + 1]);
                continue;
            }
            const double slope = double(levels[band + 1] - levels[band]) * perCell;
            const double first = double(levels[band]) + (double(from) - middleOf(band)) * slope;
            addLine(ln.data() + from, std::int32_t(to - from), float(first), float(slope));
        }
        const std::size_t last = place(middleOf(levels.size() - 1));
        addConstant(last, ln.size(), levels.back());
    }

} // namespace

const std::vector<Field<NormaliserSettings>> &NormaliserSettings::fields()
{
    using S = NormaliserSettings;
    static const std::vector<Field<S>> table{
        field(&S::halfWidthCells, "halfWidthCells", "cells", 2.0, 10000.0,
              "Half width of the frequency window of the background estimate: wider than any line, narrower than the "
              "noise's spectral shape.")
            .labelled("Half width")
            .advised("Widen it if broad signals are taken for noise; narrow it if the noise has spectral detail that "
                     "gives permanent false alarms. It does not affect the time."),
        field(&S::blockWindows, "blockWindows", "T_FT", 4.0, 1e6,
              "Length of a background block in windows: longer than any burst, shorter than the time between level "
              "changes.")
            .labelled("Block length")
            .advanced()
            .advised("Lengthen it if signals last for half of a block or more in one cell after another, because the "
                     "median over time is then theirs; shorten it if the noise changes its colour within a block."),
        field(&S::followLevel, "followLevel",
              "Divide out sudden level changes of a whole band, such as bursts, gain steps and clicks.")
            .labelled("Follow level changes")
            .advanced()
            .advised("Switch it off if signals that fill the whole band are of interest: they are divided out with the "
                     "noise. Without it, each burst gives false alarms."),
        field(&S::causal, "causal",
              "Estimate the background from the past alone, as a live run does; only the first block is estimated as a "
              "whole. Tracks are then not followed backward.")
            .advised("Switch it on to reproduce a live run. The margin for the shorter estimate costs 0.1 dB in the "
                     "first block and less later. Source: docs/theory.md."),
        field(&S::blankDc, "blankDc",
              "Leave out the middle channel of each coarse channel of a filterbank (2²⁰ channels), which holds the "
              "receiver's DC offset.")
            .labelled("Leave out DC channels")
            .advanced()
            .advised("Switch it off if the file's channels were cut out elsewhere, or its DC offset was removed: a "
                     "line in such a channel is not seen. With an offset, it costs a false alarm a coarse channel."),
    };
    return table;
}

double NoiseBackground::lnPowerAt(double seconds, double hz) const
{
    const Between t = between(time, seconds);
    const Between f = between(frequency, hz);
    const auto value = [&](Index block, Index cell) {
        return double(lnPower[std::size_t(std::min(block, time.count - 1) * frequency.count
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
        const auto sources = std::size_t(stretch->sources.count());
        const auto levelsAt = [&](Index i) {
            return stretch->sourceLevels.data()
                   + (std::min(i, stretch->firstLevel + stretch->levelCount() - 1) - stretch->firstLevel)
                         * stretch->sources.count();
        };
        std::vector<float> levels(sources);
        for (std::size_t k = 0; k < sources; ++k)
            levels[k] = levelsAt(w.lower)[k] + float(w.fraction) * (levelsAt(w.lower + 1)[k] - levelsAt(w.lower)[k]);
        readStretch(*stretch, levels, ln);
    } else {
        const Between t = between(time, seconds);
        const float *early = lnPower.data() + t.lower * frequency.count;
        const float *late = lnPower.data() + std::min(t.lower + 1, time.count - 1) * frequency.count;
        interpolateBlocks(early, late, float(t.fraction), ln.size(), ln.data());
    }
    if (bandCount == 0)
        return;
    const auto level = [&](Index band) {
        const auto at = [&](Index window) {
            return double(lnLevel[std::size_t(std::min(window, levelTime.count - 1) * bandCount + band)]);
        };
        return (1.0 - w.fraction) * at(w.lower) + w.fraction * at(w.lower + 1);
    };
    std::vector<float> levels;
    for (Index band = 0; band < bandCount; ++band)
        levels.push_back(float(level(band)));
    if (std::any_of(levels.begin(), levels.end(), [](float value) { return value != 0.0f; }))
        addBetweenBands(ln, levels);
}

Index NoiseBackground::subBandCount(double cells)
{
    return cells < 48.0 ? 0 : Index(std::clamp(cells / 96.0, 1.0, 64.0));
}

void readStretch(const NoiseStretch &stretch, std::span<const float> levels, std::span<float> ln)
{
    stretch.sources.addUp(levels, ln);
    for (std::size_t cell = 0; cell < ln.size(); ++cell)
        ln[cell] = std::max(stretch.floor, stretch.lnPower[cell] + fastLn(std::max(ln[cell], 1e-30f)));
}

} // namespace faintline
