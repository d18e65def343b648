#pragma once

#include "analysis/analyse.h"
#include "track/DetectionChain.h"

#include <memory>

namespace faintline {

/// States of its model, or of all models of its bank.
Index stateCount(const Analysis &analysis);
/// What the scores of all of them take.
std::size_t bytesOfStates(const Analysis &analysis);

/// The detection chain that an analysis's settings, model, calibration and threshold describe, at its first frame.
std::unique_ptr<DetectionChain> makeChain(const Analysis &analysis);
/// The same that does not trace tracks back to their onset: for who only wants its scores.
std::unique_ptr<DetectionChain> makeScoringChain(const Analysis &analysis);

/// The detector, or bank of detectors, of such a chain at its first frame, and the chain round a detector that may have settled on noise.
std::unique_ptr<Detector> makeDetector(const Analysis &analysis);
/// `looksBack`: whether tracks are traced back to their onset, which who only counts them does not need.
std::unique_ptr<DetectionChain> makeChain(const Analysis &analysis, std::unique_ptr<Detector> detector, bool looksBack = true);

/// The cells of a line of frames where no signal is looked for.
std::vector<CellBox> blindBoxes(const Analysis &analysis);

/// The latest of the run's checkpoints before that frame is taken; null where it is nearer to begin anew.
const ChainCheckpoint *checkpointBefore(const Analysis &analysis, Index frame);

} // namespace faintline
