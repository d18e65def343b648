#include "evaluate/experiments/scaledInjection.h"

#include "frames/Spectrogram.h"

#include <cmath>

namespace faintline {

InjectedLine scaledInjection(LineSettings line, const RecordingPointer &recording, const AnalysisSettings &settings,
                             const RunContext &context)
{
    const Spectrogram spectrogram(recording, settings.spectrogram, settings.selection);
    const RecordingInfo &info = recording->info();
    if (line.referenceSeconds <= 0.0)
        line.referenceSeconds = spectrogram.windowSeconds();
    checkLine(line, info, "line");
    const auto background = estimateBackground(spectrogram, settings.noise, context);
    const double end = line.durationSeconds > 0.0 ? line.startSeconds + line.durationSeconds : info.durationSeconds();
    const double middle = 0.5 * (line.startSeconds + end);
    const double middleHz = line.frequencyHz + line.driftHzPerSecond * (middle - line.startSeconds) - info.centreHz;
    const double noise = std::exp(background->lnPowerAt(middle, middleHz));
    return {line, toneAmplitude(line.snrDb, noise, line.referenceSeconds * info.sampleRateHz, info.isComplex)};
}

} // namespace faintline
