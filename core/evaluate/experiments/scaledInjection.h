#pragma once

#include "base/RunContext.h"
#include "plan/AnalysisSettings.h"
#include "scene/InjectedRecording.h"

namespace faintline {

/// A line to inject into a recording, scaled to its snrDb over the noise at its place: the background that the settings
/// estimate, halfway through the line, at its frequency there. A referenceSeconds of 0 selects the spectrogram's
/// window. Throws Error, Cancelled.
InjectedLine scaledInjection(LineSettings line, const RecordingPointer &recording, const AnalysisSettings &settings,
                             const RunContext &context = {});

} // namespace faintline
