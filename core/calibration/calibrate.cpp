#include "calibration/calibrate.h"

#include "calibration/calibrateOn.h"
#include "calibration/keptCalibration.h"
#include "recording/SimulatedRecording.h"
#include "spectrum/channelCount.h"
#include "spectrum/normalise.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr int segmentWindows = 4096;

    NormalisedFramesPointer noiseSegment(const AnalysisSettings &bare, int number)
    {
        LineScene scene;
        const int channels = channelCount(bare.selection);
        scene.sampleRateHz = std::ceil(ringBands(bare.family, channels));
        scene.durationSeconds = double(segmentWindows) * calibrationWindowSamples;
        scene.isComplex = true;
        scene.noise.deviation = 1.0;
        scene.seed = 1000 + number;
        const auto spectrogram =
            std::make_shared<Spectrogram>(std::make_shared<SimulatedRecording>(scene), bare.spectrogram);
        return familyFramesOnRing(normalise(spectrogram, bare.noise), bare.family, channels);
    }

} // namespace

std::shared_ptr<const Calibration> calibrate(const AnalysisSettings &settings, const RunContext &context,
                                             CalibrationDepth depth)
{
    const AnalysisSettings bare = dimensionless(settings);
    if (depth == CalibrationDepth::FirstEstimate && !isScoreOfPaths(settings.detector))
        return calibrate(settings, context);
    const CalibrationEffort effort = effortOf(depth);
    const auto result = keptCalibration(
        calibrationKey(bare, depth),
        [&] {
            const double perSegment =
                double(segmentWindows) * bare.spectrogram.stepsPerWindow
                * double(Fft::fastLength(calibrationWindowSamples * bare.spectrogram.binsPerCell));
            const int segments = std::max(4, int(std::ceil(effort.cellFrames / perSegment)));
            const NoiseSegments noise =
                rememberedSegments({[&](int number) { return noiseSegment(bare, number); }, segments});
            return calibrateOn(noise, makeModel(bare.model, noise.segment(0)->grid()), bare, effort, context);
        },
        context);
    return result ? result : calibrate(settings, context);
}

} // namespace faintline
