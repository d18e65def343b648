#include "calibrate/calibrate.h"

#include "calibrate/CalibrationRequest.h"
#include "calibrate/calibrateOn.h"
#include "calibrate/constants.h"
#include "calibrate/keptCalibration.h"
#include "frames/Spectrogram.h"
#include "noise/CausalSpectrogram.h"
#include "scene/SimulatedRecording.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    NormalisedFramesPointer noiseSegment(const AnalysisSettings &bare, int number)
    {
        LineScene scene;
        const int channels = channelCount(bare.selection);
        scene.sampleRateHz = std::ceil(ringBands(bare.family, channels));
        scene.durationSeconds = double(segmentWindows) * calibrationWindowSamples;
        scene.isComplex = true;
        scene.noise.deviation = 1.0;
        scene.seed = 1000 + number;
        const auto spectrogram = std::make_shared<Spectrogram>(simulatedInMemory(scene), bare.spectrogram);
        return familyFramesOnRing(normalise(spectrogram, bare.noise), bare.family, channels);
    }

    std::shared_ptr<const Calibration> makeWide(const AnalysisSettings &bare, const CalibrationEffort &effort,
                                                const RunContext &context)
    {
        const double perSegment = double(segmentWindows) * bare.spectrogram.stepsPerWindow
                                  * double(bare.spectrogram.transformLength(calibrationWindowSamples));
        const int segments = std::max(4, int(std::ceil(effort.cellFrames / perSegment)));
        const NoiseSegments noise =
            rememberedSegments({[&](int number) { return noiseSegment(bare, number); }, segments});
        return calibrateOn(noise, makeModel(bare.model, noise.segment(0)->grid()), bare, effort, context);
    }

    CalibrationRequest refinedRequest(const AnalysisSettings &settings)
    {
        return {dimensionless(settings)};
    }

} // namespace

std::shared_ptr<const Calibration> makeCalibration(const CalibrationRequest &request, const CalibrationEffort &effort,
                                                   const RunContext &context)
{
    if (request.model)
        return makeIndependentCalibration(request, effort, context);
    return request.bins > 0 ? makeBandCalibration(request, effort, context)
                            : makeWide(request.settings, effort, context);
}

std::shared_ptr<const Calibration> requestedCalibration(const CalibrationRequest &request, const RunContext &context)
{
    if (request.depth == CalibrationDepth::FirstEstimate) {
        CalibrationRequest refined = request;
        refined.depth = CalibrationDepth::Refined;
        if (auto calibration = cachedCalibration(refined.key()))
            return calibration;
    }
    return keptCalibration(
        request.key(),
        [&](const RunContext &making) { return makeCalibration(request, effortOf(request.depth), making); }, context);
}

std::shared_ptr<const Calibration> knownCalibration(const AnalysisSettings &settings)
{
    return cachedCalibration(refinedRequest(settings).key());
}

std::shared_ptr<const Calibration> calibrate(const AnalysisSettings &settings, const RunContext &context,
                                             CalibrationDepth depth)
{
    CalibrationRequest request = refinedRequest(settings);
    if (isScoreOfPaths(settings.detector))
        request.depth = depth;
    if (auto calibration = requestedCalibration(request, context))
        return calibration;
    return requestedCalibration(refinedRequest(settings), context);
}

} // namespace faintline
