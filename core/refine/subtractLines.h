#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"
#include "signal/ResidualRecording.h"

#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// The tracks of an analysis that its settings allow to be subtracted: lines whose mean power over the noise reaches
/// subtract.leastDb. Marked as subtracted, ordered by detection.
std::vector<Track> tracksToSubtract(const Analysis &analysis);

/// Their paths for a ResidualRecording, each smoothed over four windows (smoothFrequency).
std::vector<LinePath> pathsOf(const AnalysisPlan &plan, std::vector<Track> tracks);

/// An analysis' recording minus these lines, with noise of its own kind in their place. Throws Cancelled.
RecordingPointer restOf(const AnalysisPlan &plan, std::vector<Track> tracks, const RunContext &context = {});

/// States how many lines were subtracted and how strong they were; empty if subtraction is off.
std::string subtractionWords(const Analysis &analysis);

} // namespace faintline
