#include "noise/blockBackground.h"

#include "noise/NoiseBackground.h"
#include "noise/constants.h"
#include "noise/levels.h"
#include "noise/medians.h"

#include <algorithm>
#include <cmath>

namespace faintline {

double mostNoiseRatio(double frames)
{
    return 1.0 + 5.0 / std::sqrt(frames);
}

std::vector<bool> refine(const std::vector<float> &values, std::vector<float> &medians, Index half, double mostRatio)
{
    std::vector<double> ratios(values.size());
    std::vector<double> weights(values.size());
    std::vector<bool> isNoise(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const double ratio = std::exp(double(values[k] - medians[k]));
        isNoise[k] = ratio < mostRatio && ratio > 1.0 / mostRatio;
        ratios[k] = isNoise[k] ? ratio : 0.0;
        weights[k] = isNoise[k] ? 1.0 : 0.0;
    }
    std::vector<double> mean(values.size());
    runningMean(ratios, weights, half, mean, fewestRatioCells);
    for (std::size_t k = 0; k < values.size(); ++k)
        medians[k] += float(std::log(mean[k]));
    return isNoise;
}

BlockMedians::BlockMedians(const std::vector<float> &block, Index cells) : ofCells(std::size_t(cells), 0.0f)
{
    const Index rows = std::ssize(block) / cells;
    std::vector<Index> loud;
    for (Index row = 0; row < rows; ++row)
        if (const float peak = largest(std::span(block).subspan(std::size_t(row * cells), std::size_t(cells)));
            peak > 0.0f) {
            loud.push_back(row);
            strongest = std::max(strongest, peak);
        }
    frames = std::ssize(loud);
    if (frames == rows && rows > 0) {
        columnMedians(block, ofCells);
    } else if (frames > 0) {
        std::vector<float> together;
        for (const Index row : loud)
            together.insert(together.end(), block.begin() + row * cells, block.begin() + (row + 1) * cells);
        columnMedians(together, ofCells);
    }
}

BlockBackground blockBackground(const BlockMedians &medians, Index half)
{
    if (medians.frames == 0) {
        const std::vector<float> silent(medians.ofCells.size(), NoiseBackground::silence);
        const std::vector<bool> all(silent.size(), true);
        return {silent, silent, all, all};
    }
    const double bias = std::log(medianMean(int(medians.frames)));
    const double floor = std::log(double(medians.strongest) * roundingFloor);
    std::vector<float> ln;
    for (const float median : medians.ofCells)
        ln.push_back(float(std::max(floor, median > 0.0f ? std::log(double(median)) - bias : floor)));
    std::vector<float> background = runningMedian(ln, half);
    std::vector<bool> isNoise = refine(ln, background, half, mostNoiseRatio(double(medians.frames)));
    std::vector<bool> isFirm(isNoise.size());
    for (std::size_t cell = 0; cell < background.size(); ++cell) {
        isNoise[cell] = isNoise[cell] && double(background[cell]) > floor + roundingNearnessLn;
        isFirm[cell] = isNoise[cell] && double(background[cell]) > floor + roundingMarginLn;
        background[cell] = std::max(background[cell], float(floor));
    }
    return {std::move(ln), std::move(background), std::move(isNoise), std::move(isFirm)};
}

std::vector<float> flatten(std::vector<float> &frames, Index cells, BlockMedians &medians)
{
    const Index frameCount = std::ssize(frames) / cells;
    std::vector<float> taken(std::size_t(frameCount), 0.0f);
    if (medians.frames == 0)
        return taken;
    const std::vector<float> &typical = medians.ofCells;
    const Index stride = (cells + 499) / 500;
    const double chance = 4.5 * medianScatter(double((cells + stride - 1) / stride));
    std::vector<float> ratios;
    for (Index frame = 0; frame < frameCount; ++frame) {
        float *row = frames.data() + frame * cells;
        ratios.clear();
        for (Index cell = 0; cell < cells; cell += stride)
            if (typical[std::size_t(cell)] > 0.0f)
                ratios.push_back(row[cell] / typical[std::size_t(cell)]);
        if (ratios.empty())
            continue;
        const float ratio = medianOf(ratios);
        if (!(ratio > 0.0f) || std::abs(std::log(double(ratio))) < chance)
            continue;
        taken[std::size_t(frame)] = std::log(ratio);
        for (Index cell = 0; cell < cells; ++cell)
            row[cell] /= ratio;
    }
    if (std::ranges::any_of(taken, [](float ln) { return ln != 0.0f; }))
        medians = BlockMedians(frames, cells);
    return taken;
}

} // namespace faintline
