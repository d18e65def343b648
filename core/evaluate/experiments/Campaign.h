#pragma once

#include "evaluate/experiments/InjectionExperiment.h"
#include "evaluate/experiments/LineExperiment.h"
#include "evaluate/experiments/SweepExperiment.h"
#include "evaluate/experiments/Trials.h"

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace faintline {

/// Any experiment that gives detection probabilities.
using Experiment = std::variant<LineExperiment, InjectionExperiment, SweepExperiment>;

/// Reads an experiment by its "kind"; throws Error.
Experiment experimentFromJson(const Json &json, const std::string &where);
Json toJson(const Experiment &experiment);

/// Number of runs (fields, or single trials) of the experiment.
int runCount(const Experiment &experiment);

/// Reads the number of a run; throws Error naming `where`.
int runFromJson(const Json &json, const Experiment &experiment, const std::string &where);

void setSeed(Experiment &experiment, int seed);

/// The SNRs and the detectors of an experiment; a sweep has one SNR, and a detector for each value.
std::vector<double> snrsOf(const Experiment &experiment);
std::vector<DetectorUnderTest> detectorsOf(const Experiment &experiment);

/// The name of an experiment's recording; empty if its noise is simulated.
std::string recordingOf(const Experiment &experiment);

/// Opens the recording that an experiment names; null if its noise is simulated. Throws Error.
RecordingPointer openRecordingOf(const Experiment &experiment);

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
