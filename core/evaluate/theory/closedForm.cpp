#include "evaluate/theory/closedForm.h"

#include "evaluate/theory/theory.h"

#include <cmath>
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

} // namespace faintline
