#include "inspect/surrogates.h"

#include "analyse/analyse.h"
#include "analyse/preparePlan.h"
#include "base/Error.h"
#include "base/Interval.h"
#include "noise/NoiseNormaliser.h"
#include "noise/SurrogateRecording.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double wantedEvents = 30.0;
    constexpr std::uint64_t firstSeed = 4000;

} // namespace

SurrogateCount countOnSurrogates(RecordingPointer recording, const AnalysisSettings &settings, int runs,
                                 const RunContext &context)
{
    if (runs < 1)
        throw Error("surrogates", "must be at least 1");
    checkSettings(settings);
    checkHasOneChannel(settings, "is not possible with surrogates, which have one channel");
    const auto spectrogram = std::make_shared<const Spectrogram>(recording, settings.spectrogram, settings.selection);
    const auto background = estimateBackground(*spectrogram, settings.noise, context.part(0.0, 0.05));
    AnalysisPlan plan;
    plan.settings = settings;
    plan.frames = familyFrames({std::make_shared<NormalisedSpectrogram>(spectrogram, background, settings.noise)},
                               settings.family);
    calibratePlan(plan, context.part(0.05, 0.2));

    SurrogateCount result;
    result.runs = runs;
    result.hours = runs * double(plan.time().count) * plan.time().step / 3600.0;
    result.orderPerHour =
        std::max(plan.calibration->eventRateAt(plan.threshold) * plan.cellFramesPerHour, wantedEvents / result.hours);
    AnalysisSettings counting = settings;
    counting.decide.by = DecideSettings::By::FalseAlarmsPerHour;
    counting.decide.falseAlarmsPerHour = result.orderPerHour;
    for (int run = 0; run < runs; ++run) {
        const auto surrogate =
            std::make_shared<SurrogateRecording>(recording, settings.selection.channel, spectrogram->windowSamples(),
                                                 background, firstSeed + std::uint64_t(run));
        const auto analysis =
            analyse(surrogate, counting, {}, context.part(0.2 + 0.8 * run / runs, 0.2 + 0.8 * (run + 1) / runs));
        result.threshold = analysis->threshold;
        result.events += std::ssize(analysis->tracks);
    }
    result.ordered = result.orderPerHour * result.hours;
    const auto events = double(result.events);
    result.ratio = events / result.ordered;
    const Interval counted = poissonInterval(result.events);
    result.interval = {counted.low / result.ordered, counted.high / result.ordered};
    if (result.events > 0 && !result.interval.contains(1.0)) {
        constexpr double slopeHalfStepNats = 0.5;
        const double slope = std::log(plan.calibration->eventRateAt(result.threshold - slopeHalfStepNats)
                                      / plan.calibration->eventRateAt(result.threshold + slopeHalfStepNats))
                             / (2.0 * slopeHalfStepNats);
        result.correction = std::log(result.ratio) / slope;
    }
    return result;
}

} // namespace faintline
