#include "noise/blockBackground.h"

#include "noise/NoiseBackground.h"
#include "noise/constants.h"
#include "noise/levels.h"
#include "noise/medians.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

} // namespace

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

BlockBackground blockBackground(const std::vector<float> &frames, Index cells, Index half)
{
    const Index frameCount = std::ssize(frames) / cells;
    std::vector<float> loud; // frames without digital silence
    double strongest = 0.0;
    for (Index frame = 0; frame < frameCount; ++frame) {
        const auto row = frames.begin() + frame * cells;
        const float peak = *std::max_element(row, row + cells);
        strongest = std::max(strongest, double(peak));
        if (peak > 0.0f)
            loud.insert(loud.end(), row, row + cells);
    }
    std::vector<float> ln(std::size_t(cells), NoiseBackground::silence);
    if (loud.empty())
        return {ln, ln, std::vector<bool>(std::size_t(cells), true), std::vector<bool>(std::size_t(cells), true)};
    const auto used = int(std::ssize(loud) / cells);
    const double bias = std::log(medianMean(used));
    const double floor = std::log(strongest * roundingFloor);
    columnMedians(loud, ln);
    for (float &value : ln) {
        const auto power = double(value);
        value = float(std::max(floor, power > 0.0 ? std::log(power) - bias : floor));
    }
    std::vector<float> background = runningMedian(ln, half);
    std::vector<bool> isNoise = refine(ln, background, half, mostNoiseRatio(double(used)));
    std::vector<bool> isFirm(isNoise.size());
    for (std::size_t cell = 0; cell < background.size(); ++cell) {
        isNoise[cell] = isNoise[cell] && double(background[cell]) > floor + roundingNearnessLn;
        isFirm[cell] = isNoise[cell] && double(background[cell]) > floor + roundingMarginLn;
        background[cell] = std::max(background[cell], float(floor));
    }
    return {std::move(ln), std::move(background), std::move(isNoise), std::move(isFirm)};
}

std::vector<float> flatten(std::vector<float> &frames, Index cells)
{
    const Index frameCount = std::ssize(frames) / cells;
    std::vector<float> taken(std::size_t(frameCount), 0.0f);
    std::vector<float> loud;
    for (Index frame = 0; frame < frameCount; ++frame)
        if (const auto row = frames.begin() + frame * cells;
            std::any_of(row, row + cells, [](float y) { return y > 0.0f; }))
            loud.insert(loud.end(), row, row + cells);
    if (loud.empty())
        return taken;
    std::vector<float> typical(static_cast<std::size_t>(cells));
    columnMedians(loud, typical);
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
    return taken;
}

} // namespace faintline
