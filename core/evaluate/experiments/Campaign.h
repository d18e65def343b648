#pragma once

#include "base/Interval.h"
#include "evaluate/experiments/InjectionExperiment.h"
#include "evaluate/experiments/LineExperiment.h"
#include "evaluate/experiments/RunOutcome.h"
#include "evaluate/experiments/SweepExperiment.h"

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace faintline {

/// Any experiment that yields detection probabilities.
using Experiment = std::variant<LineExperiment, InjectionExperiment, SweepExperiment>;

/// By its "kind"; throws Error.
Experiment experimentFromJson(const Json &json, const std::string &where);
Json toJson(const Experiment &experiment);

/// How many runs (fields, or single trials) the experiment consists of.
int runCount(const Experiment &experiment);

/// The number of one of them; throws Error naming `where`.
int runFromJson(const Json &json, const Experiment &experiment, const std::string &where);

void setSeed(Experiment &experiment, int seed);

/// The signal-to-noise ratios and the detectors of an experiment; a sweep has one ratio, and a detector for each value.
std::vector<double> snrsOf(const Experiment &experiment);
std::vector<DetectorUnderTest> detectorsOf(const Experiment &experiment);

/// An experiment with as many of its runs as have been done: a part of a campaign, or all of it.
struct Campaign {
    Experiment experiment;
    std::vector<double> thresholds;   ///< of each detector; empty where every noise block's maximum is one
    std::vector<RunOutcome> outcomes; ///< ascending in run
};

/// Does those of `runs` that `campaign` does not hold yet and adds them; `sink` sees every new one. For a new campaign
/// only the experiment is set. Results do not depend on how the work is divided. Throws Error, Cancelled.
void carryOut(Campaign &campaign, const std::vector<int> &runs, const RunContext &context = {},
              const RunSink &sink = {});

/// Prepares a campaign: calibrates thresholds where the experiment asks for them.
Campaign begin(const Experiment &experiment, const RunContext &context = {});

/// The runs that belong to shard `index` of `count`: those with run ≡ index (mod count).
std::vector<int> runsOfShard(const Experiment &experiment, int index, int count);

/// One campaign from parts of the same experiment. Throws Error where they differ, overlap or leave a run out.
Campaign merge(std::vector<Campaign> parts);

} // namespace faintline
