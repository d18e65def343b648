#pragma once

#include "analysis/Analysis.h"

#include <memory>

namespace faintline {

/// States of its model, or of all models of its bank.
Index stateCount(const AnalysisPlan &plan);
/// What the scores of all of them take.
std::size_t bytesOfStates(const AnalysisPlan &plan);

/// The detection chain of a plan, at its first frame.
std::unique_ptr<DetectionChain> makeChain(const AnalysisPlan &plan);
/// The same that does not trace tracks back to their onset: for a caller that only wants its scores.
std::unique_ptr<DetectionChain> makeScoringChain(const AnalysisPlan &plan);

/// The plan's detector, or bank of detectors, at its first frame.
std::unique_ptr<Detector> makeDetector(const AnalysisPlan &plan);
/// The same with paths for tracks to start from: a detector without any is guided by one that has them.
std::unique_ptr<PathDetector> makePathDetector(const AnalysisPlan &plan);

/// The chain around a detector that may have settled on noise. `looksBack`: whether tracks are traced back to their
/// onset, which a caller that only counts them does not need.
std::unique_ptr<DetectionChain> makeChain(const AnalysisPlan &plan, std::unique_ptr<PathDetector> detector,
                                          bool looksBack = true);

/// The cells of a line of frames where no signal is looked for.
std::vector<CellBox> excludedBoxes(const AnalysisPlan &plan);

} // namespace faintline
