#include "analyse/preparePlan.h"

#include "analyse/usable.h"
#include "noise/CausalSpectrogram.h"
#include "noise/NoiseNormaliser.h"
#include "signal/endless.h"

namespace faintline {

namespace {

    struct NormalisedChannel {
        NormalisedFramesPointer frames;
        std::shared_ptr<const NoiseBackground> background;
    };

    NormalisedChannel normalisedChannel(const std::shared_ptr<const Spectrogram> &spectrogram,
                                        const NormaliserSettings &settings, const RunContext &context)
    {
        NormalisedChannel channel;
        if (settings.causal) {
            const auto frames = std::make_shared<CausalSpectrogram>(spectrogram, settings);
            channel = {frames, frames->firstBackground()};
        } else {
            channel.background = estimateBackground(*spectrogram, settings, context);
            channel.frames = std::make_shared<NormalisedSpectrogram>(spectrogram, channel.background, settings);
        }
        if (spectrogram->recording().info().sampleCount < endlessSamples)                  // finished recordings only
            (void)silenceWords(*spectrogram, *channel.background, context.part(1.0, 1.0)); // throws if unusable
        return channel;
    }

    /// The same spectrogram for another channel.
    std::shared_ptr<const Spectrogram> ofChannel(const std::shared_ptr<const Spectrogram> &spectrogram, int channel)
    {
        SelectionSettings selection = spectrogram->selection();
        if (channel == selection.channel)
            return spectrogram;
        selection.channel = channel;
        return std::make_shared<Spectrogram>(spectrogram->recordingPointer(), spectrogram->settings(), selection);
    }

} // namespace

void normalisePlan(AnalysisPlan &plan, std::shared_ptr<const Spectrogram> spectrogram, const RunContext &context)
{
    const std::vector<int> channels = channelsOf(plan.settings.selection, spectrogram->recording().info());
    const auto count = double(channels.size());
    plan.lines.clear();
    for (const int channel : channels) {
        const auto done = double(plan.lines.size());
        const NormalisedChannel one = normalisedChannel(ofChannel(spectrogram, channel), plan.settings.noise,
                                                        context.part(done / count, (done + 1.0) / count));
        if (plan.lines.empty())
            plan.background = one.background;
        plan.lines.push_back(one.frames);
    }
    plan.frames = familyFrames(plan.lines, plan.settings.family);
}

void calibratePlan(AnalysisPlan &plan, const RunContext &context, CalibrationDepth depth)
{
    plan.model = makeModel(plan.settings.model, plan.grid());
    const Spectrogram &spectrogram = *plan.frames->spectrogram();
    plan.calibration = calibrateBand(plan.settings, spectrogram, context, depth);
    plan.cellFramesPerHour = cellFramesInAnHour(plan.settings, spectrogram);
    plan.threshold = thresholdNats(plan.settings.decide, *plan.calibration, plan.cellFramesPerHour);
}

NormalisedFramesPointer framesOfLines(const AnalysisPlan &plan)
{
    return plan.lines.empty() ? plan.frames : familyFrames(plan.lines, {});
}

} // namespace faintline
