#include "plan/slopeUnit.h"

#include "plan/constants.h"

#include <cmath>

namespace faintline {

namespace {

    double fourDigits(double value)
    {
        if (value == 0.0)
            return 0.0;
        const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 3.0);
        const double digits = std::round(value / unit);
        // 10⁻ⁿ has no exact double; an integer divided by 10ⁿ reads back as written
        return unit < 1.0 ? digits / std::round(1.0 / unit) : digits * std::round(unit);
    }

} // namespace

double hzPerSecondOfABinAFrame(const AnalysisSettings &settings, const RecordingInfo &info)
{
    const Spectrogram::Steps steps = Spectrogram::stepsOf(settings.spectrogram, info);
    return steps.hz / (steps.seconds * familyCellsPerBin(settings.family));
}

ModelSettings withSlopesIn(SlopeUnit unit, ModelSettings model, double hzPerSecond)
{
    if (model.slopeUnit == unit)
        return model;
    model.slopeUnit = unit;
    if (unit == SlopeUnit::HzPerSecond) {
        model.lowestSlope = fourDigits(model.lowestSlope * hzPerSecond);
        model.highestSlope = fourDigits(model.highestSlope * hzPerSecond);
    } else {
        const double steps = model.slopesPerBin / hzPerSecond;
        model.lowestSlope = (std::floor(model.lowestSlope * steps + slopeToleranceSteps) + 0.0) / model.slopesPerBin;
        model.highestSlope = (std::ceil(model.highestSlope * steps - slopeToleranceSteps) + 0.0) / model.slopesPerBin;
    }
    return model;
}

AnalysisSettings withSlopesInBins(AnalysisSettings settings, const RecordingInfo &info)
{
    if (settings.model.slopeUnit != SlopeUnit::BinsPerFrame)
        settings.model = withSlopesIn(SlopeUnit::BinsPerFrame, settings.model, hzPerSecondOfABinAFrame(settings, info));
    return settings;
}

AnalysisSettings withSlopesInBins(AnalysisSettings settings, const NormalisedFrames &frames)
{
    settings.model =
        withSlopesIn(SlopeUnit::BinsPerFrame, settings.model, frames.grid().axes.back().step / frames.time().step);
    return settings;
}

} // namespace faintline
