#include "analysis/plan.h"

#include "analysis/usable.h"
#include "recording/endless.h"
#include "spectrum/CausalSpectrogram.h"
#include "spectrum/NoiseNormaliser.h"

namespace faintline {

void normalisePlan(AnalysisPlan &plan, std::shared_ptr<const Spectrogram> spectrogram, const RunContext &context)
{
    const NormaliserSettings &settings = plan.settings.noise;
    if (settings.causal) {
        const auto frames = std::make_shared<CausalSpectrogram>(spectrogram, settings);
        plan.background = frames->firstBackground();
        plan.frames = frames;
    } else {
        plan.background = estimateBackground(*spectrogram, settings, context);
        plan.frames = std::make_shared<NormalisedSpectrogram>(spectrogram, plan.background, settings);
    }
    plan.frames = familyFrames(plan.frames, plan.settings.family);
    if (spectrogram->recording().info().sampleCount < endlessSamples) // whose samples can be looked at
        checkUsable(*spectrogram, *plan.background, context.part(1.0, 1.0));
}

void calibratePlan(AnalysisPlan &plan, const RunContext &context, CalibrationDepth depth)
{
    plan.model = makeModel(plan.settings.model, plan.grid());
    plan.calibration = calibrateBand(plan.settings, *plan.frames->spectrogram(), context, depth);
    plan.cellFramesPerHour = double(plan.grid().size()) * 3600.0 / plan.time().step;
    plan.threshold = thresholdNats(plan.settings.decide, *plan.calibration, plan.cellFramesPerHour);
}

NormalisedFramesPointer framesOfLines(const AnalysisPlan &plan)
{
    if (plan.settings.family.isNone())
        return plan.frames;
    const std::shared_ptr<const Spectrogram> spectrogram(plan.frames, plan.frames->spectrogram());
    return std::make_shared<NormalisedSpectrogram>(spectrogram, plan.background, plan.settings.noise);
}

} // namespace faintline
