#include "spectrum/addStretch.h"

#include "spectrum/bandLevels.h"
#include "spectrum/between.h"
#include "spectrum/blockBackground.h"
#include "spectrum/unevenness.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr float silence = NoiseBackground::silence;

    /// frames ← frames·e^(-ln)
    void divide(std::span<float> frame, std::span<const float> ln)
    {
        for (std::size_t cell = 0; cell < frame.size(); ++cell)
            frame[cell] *= std::exp(-ln[cell]);
    }

} // namespace

void addStretch(NoiseBackground &background, const StretchFrames &stretchFrames, Index half, double likeness,
                std::vector<float> &levels)
{
    constexpr Index cellsForThree = 144;
    constexpr double better = 1.1;
    constexpr double explained = 1.3;
    const Index cells = background.frequency.count;
    const double expected = Unevenness::ofNoise(likeness);
    std::vector<float> frames = stretchFrames.read(0, cells);
    const float strongest = *std::max_element(frames.begin(), frames.end());
    const Between t = between(
        background.time,
        background.levelTime.value(double((stretchFrames.first + stretchFrames.count / 2) * stretchFrames.steps)));
    const auto row = background.lnPower.begin() + t.lower * cells;
    if (!(strongest > 0.0f) || *row <= silence)
        return;
    NoiseStretch stretch;
    stretch.firstLevel = stretchFrames.first * stretchFrames.steps;
    stretch.lnPower.assign(row, row + cells);
    stretch.floor = std::log(strongest) + float(std::log(roundingFloor));
    const auto frameOf = [&](std::vector<float> &all, Index frame) {
        return std::span(all).subspan(std::size_t(frame * cells), std::size_t(cells));
    };
    std::vector<float> ln(static_cast<std::size_t>(cells));
    std::vector<float> before = frames;
    for (Index frame = 0; frame < stretchFrames.count; ++frame) {
        background.readLnPower(background.levelTime.value(double((stretchFrames.first + frame) * stretchFrames.steps)),
                               ln);
        divide(frameOf(before, frame), ln);
        divide(frameOf(frames, frame), stretch.lnPower);
    }
    const std::vector<float> asTheyAre(std::size_t(cells), 1.0f);
    const std::vector<float> each(std::size_t(stretchFrames.count), 1.0f);
    const Unevenness unevennessBefore = unevenness(before, asTheyAre, each);
    before = {};
    stretch.sources = fitSources(frames, cells, cells < cellsForThree ? 2 : 3, half);
    if (stretch.sources.count() == 0)
        return;
    const Index sources = stretch.sources.count();
    stretch.sourceLevels.assign(std::size_t(stretchFrames.count * stretchFrames.steps * sources), 0.0f);
    const auto divideByNoise = [&](std::vector<float> &all, Index shift) { // which is there already divided by lnPower
        for (Index frame = 0; frame < std::ssize(all) / cells; ++frame) {
            const auto values = frameOf(all, frame);
            const std::vector<float> own = stretch.sources.levelsIn(values);
            std::copy(own.begin(), own.end(),
                      stretch.sourceLevels.begin() + (frame * stretchFrames.steps + shift) * sources);
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
            const float level = own[std::size_t(i)];
            levels[std::size_t(place * columns + i % columns)] =
                level < levelNotKnown ? level - shareOfLines(offsets[std::size_t(i % columns)]) : levelNotKnown;
        }
    }
    background.stretches.push_back(std::move(stretch));
}

} // namespace faintline
