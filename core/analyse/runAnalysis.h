#pragma once

#include "analyse/AnalysisRequest.h"
#include "base/RunContext.h"
#include "plan/Analysis.h"
#include "signal/Recording.h"

#include <memory>
#include <utility>

namespace faintline {

struct RunRequest : AnalysisRequest {
    RunRequest(AnalysisRequest request) : AnalysisRequest(std::move(request)), isTrial(depth == AnalysisDepth::Trial) {}

    bool isTrial; ///< whether the tracks are those of a trial; a trial of greater depth has its pictures, too
};

/// Analyses a recording in the window of the settings, T0 if they leave it open.
std::shared_ptr<Analysis> runOnRecording(const RecordingPointer &recording, const AnalysisSettings &settings,
                                         const RunRequest &request, const RunContext &context);

/// Analyses ready-made frames on any grid.
std::shared_ptr<const Analysis> runOnFrames(NormalisedFramesPointer frames, const AnalysisSettings &settings,
                                            const RunRequest &request, const RunContext &context);

} // namespace faintline
