#pragma once

#include "detect/PathDetector.h"
#include "plan/AnalysisPlan.h"
#include "track/DetectionChain.h"

#include <memory>

namespace faintline {

/// Memory for the scores of all states of the model, or of all models of the bank.
std::size_t bytesOfStates(const AnalysisPlan &plan);

/// The detection chain of a plan, at its first frame.
std::unique_ptr<DetectionChain> makeChain(const AnalysisPlan &plan);

/// The plan's detector, or bank of detectors, at its first frame.
std::unique_ptr<Detector> makeDetector(const AnalysisPlan &plan);
/// The same with paths from which tracks can start: a detector without paths is guided by one with paths.
/// `showsStatistic`: also where tracks follow something (PathDetector::showStatistic), which is not needed for counting.
std::unique_ptr<PathDetector> makePathDetector(const AnalysisPlan &plan, bool showsStatistic = false);

/// The chain around a detector that may already have settled on noise. `looksBack`: whether tracks are traced back to
/// their onset, which is not needed for counting.
std::unique_ptr<DetectionChain> makeChain(const AnalysisPlan &plan, std::unique_ptr<PathDetector> detector,
                                          bool looksBack = true);

/// Excluded cells, where no signal is looked for, for frames of lines.
std::vector<CellBox> excludedBoxes(const AnalysisPlan &plan);

} // namespace faintline
