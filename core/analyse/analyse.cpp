#include "analyse/analyse.h"

#include "analyse/chooseWindow.h"
#include "analyse/runAnalysis.h"
#include "base/Error.h"
#include "plan/slopeUnit.h"

namespace faintline {

std::shared_ptr<const Analysis> analyse(const OpenedSource &source, const AnalysisSettings &settings,
                                        const AnalysisRequest &request, const RunContext &context)
{
    if (!source.frames) {
        if (request.model)
            throw Error("model", "requires ready-made frames; a recording's model is in its settings");
        const AnalysisSettings inBins = withSlopesInBins(settings, source.recording->info());
        return leavesWindowToRecording(inBins) ? runInChosenWindow(source.recording, inBins, request, context)
                                               : runOnRecording(source.recording, inBins, request, context);
    }
    const NormalisedFramesPointer frames = source.framesFor(settings, context.part(0.0, 0.2));
    const bool isOverFrequency = frames->grid().isSpectrum() && frames->grid().axes.back().unit == "Hz";
    return runOnFrames(frames, isOverFrequency ? withSlopesInBins(settings, *frames) : settings, request,
                       frames == source.frames ? context : context.part(0.2, 1.0));
}

} // namespace faintline
