// A changed detector: what is seen at once, beside the whole analysis that follows. 2000 cells × 1000 frames, one
// thread.

#include "analyse/analyse.h"
#include "calibrate/calibrate.h"
#include "inspect/previewStatistic.h"
#include "scene/SimulatedRecording.h"

#include <benchmark/benchmark.h>

using namespace faintline;

namespace {

const Analysis &before()
{
    static const std::shared_ptr<const Analysis> analysis = [] {
        LineScene scene{.sampleRateHz = 4000.0, .durationSeconds = 250.5};
        AnalysisSettings settings;
        settings.spectrogram.windowSeconds = 0.5;
        return analyse(std::make_shared<SimulatedRecording>(scene), settings);
    }();
    return *analysis;
}

AnalysisSettings changed()
{
    AnalysisSettings settings = before().settings;
    settings.model.snr = 0.3;
    return settings;
}

void previewOfKeptFrames(benchmark::State &state)
{
    const FrameRange range = previewRange(*before().frames, 0, 999);
    const KeptFrames kept(before().frames, range.readFirst, range.end - range.readFirst);
    for ([[maybe_unused]] auto turn : state)
        benchmark::DoNotOptimize(previewStatistic(before(), changed(), range, kept).lnK);
    state.SetItemsProcessed(state.iterations() * range.end * before().grid().size());
}

void previewWithFramesToRead(benchmark::State &state)
{
    const FrameRange range = previewRange(*before().frames, 0, 999);
    for ([[maybe_unused]] auto turn : state) {
        const KeptFrames kept(before().frames, range.readFirst, range.end - range.readFirst);
        benchmark::DoNotOptimize(previewStatistic(before(), changed(), range, kept).lnK);
    }
}

void analysisCalibratedBefore(benchmark::State &state)
{
    calibrate(changed());
    for ([[maybe_unused]] auto turn : state)
        benchmark::DoNotOptimize(analyse(before().recording, changed(), {.previous = &before()})->threshold);
}

void calibrationOnly(benchmark::State &state)
{
    AnalysisSettings settings = changed();
    for ([[maybe_unused]] auto turn : state) {
        settings.model.snr *= 1.001; // never seen
        benchmark::DoNotOptimize(calibrate(settings)->lnK);
    }
}

BENCHMARK(previewOfKeptFrames)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(previewWithFramesToRead)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(analysisCalibratedBefore)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(calibrationOnly)->Unit(benchmark::kMillisecond)->UseRealTime()->Iterations(1);

} // namespace
