#include "evaluate/theory/closedForm.h"

#include "evaluate/theory/theory.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>

namespace faintline {

namespace {

    constexpr double smallestDrawnProbability = 1e-15;
    constexpr double step = 0.25;
    constexpr double highestLevel = 1000.0;

    using Law = std::function<double(double level)>; ///< negative where it says nothing

    Law lawOf(const AnalysisSettings &settings, const Calibration &calibration)
    {
        const bool isIndependentInTime = settings.spectrogram.stepsPerWindow == 1;
        const ModelSettings &model = settings.model;
        if (std::holds_alternative<EnergySettings>(settings.detector))
            return [](double level) { return std::exp(-level); };
        if (const auto *integrator = std::get_if<IntegratorSettings>(&settings.detector);
            integrator && isIndependentInTime && integrator->shape == IntegratorSettings::Shape::Boxcar) {
            const int looks = int(std::lround(integrator->durationWindows));
            if (looks >= 1 && double(looks) == integrator->durationWindows)
                return [looks](double level) { return level > 0.0 ? pfaOfMeanPower(level, looks) : 1.0; };
        }
        const auto *smd = std::get_if<SmdSettings>(&settings.detector);
        const bool isOneToOne = model.motion == Motion::Slopes && model.lowestSlope == model.highestSlope;
        if (smd && isIndependentInTime && isOneToOne && model.likelihood == LikelihoodKind::Linear
            && calibration.lnK < -1.0
            && (smd->reset == SmdSettings::Reset::Fixed || smd->reset == SmdSettings::Reset::Calibrated))
            return [lnK = calibration.lnK](double level) {
                return level + lnK >= 0.0 ? lindleyExceedance(level + lnK, lnK) : -1.0;
            };
        return {};
    }

} // namespace

std::vector<ExceedancePoint> closedFormExceedance(const AnalysisSettings &settings, const Calibration &calibration)
{
    std::vector<ExceedancePoint> points;
    const Law law = lawOf(settings, calibration);
    if (!law)
        return points;
    for (double level = 0.0; level < highestLevel; level += step) {
        const double probability = law(level);
        if (probability < 0.0)
            continue; // below where the law holds
        if (!(probability >= smallestDrawnProbability))
            break;
        points.push_back({level, probability});
    }
    return points;
}

namespace {

    constexpr Index mostCells = 2'000'000;
    constexpr std::int64_t pointMinimumCells = 10; ///< cells above a level that is worth a point

} // namespace

std::vector<ExceedancePoint> boxExceedance(const PeakPyramid &statistic, Index beginFrame, Index endFrame,
                                           Index beginCell, Index endCell)
{
    beginFrame = std::clamp<Index>(beginFrame, 0, statistic.frameCount());
    endFrame = std::clamp<Index>(endFrame, beginFrame, statistic.frameCount());
    beginCell = std::clamp<Index>(beginCell, 0, statistic.cells());
    endCell = std::clamp<Index>(endCell, beginCell, statistic.cells());
    const Index width = endCell - beginCell;
    std::vector<ExceedancePoint> points;
    if (statistic.framesPerRow(0) != 1 || width == 0 || beginFrame == endFrame)
        return points;
    const Index stride = std::max<Index>(1, (endFrame - beginFrame) * width / mostCells);
    std::array<std::int64_t, 256> counts{};
    std::int64_t total = 0;
    for (Index frame = beginFrame; frame < endFrame; frame += stride) {
        const auto row = statistic.row(0, frame);
        for (const std::uint8_t byte : row.subspan(std::size_t(beginCell), std::size_t(width)))
            ++counts[byte];
        total += width;
    }
    // Half the way to the next byte's value lies what rounding takes for it.
    std::int64_t above = total;
    for (int byte = 0; byte < 255; ++byte) {
        above -= counts[std::size_t(byte)];
        if (above < pointMinimumCells)
            break;
        points.push_back(
            {0.5 * (statistic.scale().value(byte) + statistic.scale().value(byte + 1)), double(above) / double(total)});
    }
    return points;
}

} // namespace faintline
