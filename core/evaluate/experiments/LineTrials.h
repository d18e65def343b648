#pragma once

#include "detect/Smd.h"
#include "evaluate/experiments/Experiment.h"
#include "evaluate/experiments/Trials.h"
#include "frames/NormalisedFrames.h"

#include <memory>
#include <vector>

namespace faintline {

/// The runs of lines in simulated noise. They need no thresholds.
class LineTrials : public Trials
{
public:
    /// Determines K of each detector on the experiment's own noise. Throws Error, Cancelled.
    explicit LineTrials(const Experiment &experiment, const RunContext &context = {});

    /// One rule per detector; the default for detectors without one.
    const std::vector<ResetRule> &resets() const { return m_resets; }

private:
    RunOutcome outcomeOf(int run, const RunContext &quiet) const override;

    Experiment m_experiment;
    std::vector<MarkovModel> m_models; ///< of each detector
    std::vector<ResetRule> m_resets;
};

/// With these, a detector that is `detect` as a whole analyses a field: one false alarm per block.
AnalysisSettings wholeSettings(const Experiment &experiment, std::size_t detector);

/// One signal of one run, regenerated alone.
struct LineTrial {
    /// Its block, y with noise of mean 1; the axes are frequency in cells and time in windows.
    std::shared_ptr<const FrameArray> frames;
    Index firstFrame = 0;    ///< of the line, in the block
    std::vector<Index> path; ///< its bin in the block, one per frame of its duration
};
LineTrial remakeTrial(const Experiment &experiment, double snrDb, int run, int signal);

/// One run with all its lines, and the truth of one of them.
MadeTrial remakeField(const Experiment &experiment, double snrDb, int run, int signal);

} // namespace faintline
