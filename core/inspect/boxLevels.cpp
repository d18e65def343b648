#include "inspect/boxLevels.h"

#include "base/Error.h"
#include "noise/levels.h"
#include "plan/Calibration.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace faintline {

namespace {

    constexpr Index mostFrames = 4096;
    constexpr Index mostNoiseCells = 4'000'000;
    constexpr double sideCells = 8.0; ///< minimum width on either side, resolution cells
    constexpr double gapCells = 2.0;

    double decibels(double power)
    {
        return 10.0 * std::log10(power);
    }

    void check(const Grid &grid, Index frameCount, const FrameBox &box)
    {
        if (!grid.isSpectrum())
            throw Error("box", "can be measured only in spectra, which have one axis");
        const bool isThere = box.beginFrame >= 0 && box.beginFrame < box.endFrame && box.endFrame <= frameCount
                             && box.beginCell >= 0 && box.beginCell < box.endCell && box.endCell <= grid.size();
        if (!isThere)
            throw Error("box", "must contain at least one frame and one cell, and lie within the recording");
    }

    /// The cells beside a box: [firstBegin, firstEnd) and [secondBegin, secondEnd).
    struct Sides {
        Index firstBegin, firstEnd, secondBegin, secondEnd;

        Sides(const FrameBox &box, Index cellCount, double binsPerCell)
        {
            const auto gap = Index(std::ceil(gapCells * binsPerCell));
            const Index width = std::max(box.endCell - box.beginCell, Index(std::ceil(sideCells * binsPerCell)));
            firstEnd = std::max<Index>(box.beginCell - gap, 0);
            firstBegin = std::max<Index>(firstEnd - width, 0);
            secondBegin = std::min(box.endCell + gap, cellCount);
            secondEnd = std::min(secondBegin + width, cellCount);
        }
        Index cells() const { return firstEnd - firstBegin + secondEnd - secondBegin; }
    };

    double noiseOf(std::vector<float> &cells)
    {
        if (cells.empty())
            return 1.0; // the box covers the band: use the frames' nominal noise
        const double guess = medianOf(cells) / std::log(2.0);
        const double mean = guess > 0.0 ? truncatedMean(cells, float(guess)) : 0.0;
        return mean > 0.0 ? mean : 1.0;
    }

} // namespace

BoxLevels boxLevels(const Analysis &analysis, const FrameBox &box, const RunContext &context)
{
    const NormalisedFrames &frames = *analysis.frames;
    check(frames.grid(), frames.time().count, box);
    const double binsPerCell = analysis.recording ? frameGeometry(analysis.settings.spectrogram).binsPerCell : 1.0;
    const Sides sides(box, frames.grid().size(), binsPerCell);
    const Index span = box.endFrame - box.beginFrame;
    const Index count = std::min(span, mostFrames);
    const Index noiseStride = std::max<Index>(1, (count * sides.cells() + mostNoiseCells - 1) / mostNoiseCells);

    std::vector<float> frame(std::size_t(frames.grid().size()));
    std::vector<float> noise;
    double sum = 0.0;
    Index seen = 0;
    Index observed = 0;
    const auto gather = [&](Index begin, Index end) {
        for (Index cell = begin; cell < end; ++cell)
            if (seen++ % noiseStride == 0 && !std::isnan(frame[std::size_t(cell)]))
                noise.push_back(frame[std::size_t(cell)]);
    };
    for (Index i = 0; i < count; ++i) {
        context.checkpoint(double(i) / double(count), "measuring the box");
        frames.read(box.beginFrame + i * span / count, 1, frame);
        for (Index cell = box.beginCell; cell < box.endCell; ++cell) {
            const float value = frame[std::size_t(cell)];
            if (std::isnan(value)) // not observed
                continue;
            sum += value;
            ++observed;
        }
        gather(sides.firstBegin, sides.firstEnd);
        gather(sides.secondBegin, sides.secondEnd);
    }

    const double cells = double(std::max<Index>(1, observed));
    const double mean = noiseOf(noise);
    const double frameCount = cells / double(box.endCell - box.beginCell);
    const double ratio = (sum / mean - cells) / (frameCount * binsPerCell);
    BoxLevels levels{decibels(sum / cells), {}};
    if (ratio > 0.0)
        levels.snrDb = decibels(ratio);
    return levels;
}

} // namespace faintline
