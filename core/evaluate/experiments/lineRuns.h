#pragma once

#include "base/RunContext.h"
#include "detect/Smd.h"
#include "evaluate/experiments/LineExperiment.h"
#include "evaluate/experiments/RunOutcome.h"
#include "frames/NormalisedFrames.h"
#include "scene/Truth.h"
#include "signal/Recording.h"

#include <memory>
#include <vector>

namespace faintline {

/// The reset rule of each detector of the experiment, with K determined on the experiment's own noise (default for
/// detectors without one).
std::vector<ResetRule> calibratedResets(const LineExperiment &experiment, const RunContext &context = {});

/// With these, a detector that is `detect` as a whole analyses a field: one false alarm per block.
AnalysisSettings wholeSettings(const LineExperiment &experiment, std::size_t detector);

/// Executes the given runs on context.threads threads; the result is in the order of `runs` and depends only on the
/// experiment. K of sequential Markov detectors is calibrated first. Throws Error, Cancelled.
std::vector<RunOutcome> runExperiment(const LineExperiment &experiment, const std::vector<int> &runs,
                                      const RunContext &context = {}, const RunSink &sink = {});

/// One signal of one run, regenerated alone.
struct LineTrial {
    /// Its block, y with noise of mean 1; the axes are frequency in cells and time in windows.
    std::shared_ptr<const FrameArray> frames;
    Index firstFrame = 0;    ///< of the line, in the block
    std::vector<Index> path; ///< its bin in the block, one per frame of its duration
};
LineTrial remakeTrial(const LineExperiment &experiment, double snrDb, int run, int signal);

/// The samples of one run with all its lines, and the truth of one of them.
struct FieldTrial {
    RecordingPointer recording;
    TruthLine line;
};
FieldTrial remakeField(const LineExperiment &experiment, double snrDb, int run, int signal);

} // namespace faintline
