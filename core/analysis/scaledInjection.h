#pragma once

#include "analysis/AnalysisSettings.h"
#include "base/RunContext.h"
#include "recording/InjectedRecording.h"

namespace faintline {

/// A line to be added to a recording, made as strong as its snrDb asks for over the noise at its place: the background
/// that the settings estimate, halfway through the line, at its frequency there. A referenceSeconds of 0 stands for the
/// spectrogram's window. Throws Error, Cancelled.
InjectedLine scaledInjection(LineSettings line, const RecordingPointer &recording, const AnalysisSettings &settings,
                             const RunContext &context = {});

} // namespace faintline
