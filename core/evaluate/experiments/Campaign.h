#pragma once

#include "evaluate/experiments/Experiment.h"
#include "evaluate/experiments/Trials.h"

#include <memory>
#include <vector>

namespace faintline {

/// Prepares an experiment's runs; the recording is the one that it names. Throws Error, Cancelled.
std::unique_ptr<const Trials> prepareTrials(const Experiment &experiment, RecordingPointer recording,
                                            const RunContext &context = {});

/// An experiment with the runs done so far: a part of a campaign, or all of it.
struct Campaign {
    Experiment experiment;
    std::vector<double> thresholds;   ///< for each detector; empty: each noise block's maximum serves as one
    std::vector<RunOutcome> outcomes; ///< in ascending order of runs
};

/// Those of `runs` that a campaign does not hold yet.
std::vector<int> openRuns(const Campaign &campaign, std::vector<int> runs);

/// Executes the open ones of `runs` and adds them; `sink` receives each new one. A new campaign needs only the
/// experiment. Results do not depend on how the work is divided. `trials`: those of the experiment, if they are
/// prepared. Throws Error, Cancelled.
void carryOut(Campaign &campaign, const std::vector<int> &runs, const RunContext &context = {},
              const RunSink &sink = {});
void carryOut(Campaign &campaign, const std::vector<int> &runs, const Trials &trials, const RunContext &context = {},
              const RunSink &sink = {});

/// The runs of shard `index` of `count`: those with run ≡ index (mod count).
std::vector<int> runsOfShard(const Experiment &experiment, int index, int count);

/// Merges parts of the same experiment into one campaign. Throws Error if they differ, overlap or lack a run.
Campaign merge(std::vector<Campaign> parts);

} // namespace faintline
