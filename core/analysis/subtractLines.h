#pragma once

#include "analysis/Analysis.h"
#include "base/RunContext.h"
#include "spectrum/ResidualRecording.h"

#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// The tracks of an analysis that its settings let be subtracted: lines whose mean power over the noise reaches
/// subtract.leastDb. Marked as subtracted, by detection.
std::vector<Track> tracksToSubtract(const Analysis &analysis);

/// Their paths, for a ResidualRecording: each along its track, smoothed over four windows (smoothFrequency).
std::vector<LinePath> pathsOf(const AnalysisPlan &plan, std::vector<Track> tracks);

/// An analysis' recording less such lines, with noise of its own kind where they were. Throws Cancelled.
RecordingPointer restOf(const AnalysisPlan &plan, std::vector<Track> tracks, const RunContext &context = {});

/// How many lines were subtracted, and how strong they were; empty where the settings do not ask for it.
std::string subtractionWords(const Analysis &analysis);

} // namespace faintline
