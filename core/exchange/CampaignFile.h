#pragma once

#include "evaluate/experiments/campaignCurve.h"

#include <string>

namespace faintline {

/// A campaign's runs on disk, one line of JSON each after a line that holds the experiment: what shards are exchanged
/// in, and what an interrupted campaign resumes from. A line that was cut off while it was being written is left out
/// when read.
///
///   {"faintlineCampaign": 1, "experiment": {…}, "thresholds": […]}
///   {"run": 0, "noise": [[…]], "signal": [[[…]]]}
void writeCampaign(const Campaign &campaign, const std::string &path);

/// Throws Error naming the file and line.
Campaign readCampaign(const std::string &path);

/// Whether the file's first line says that it is a campaign.
bool isCampaignFile(const std::string &path);

/// Detection probabilities as CSV: detector, snr_db, pd, pd_low, pd_high (95 %), trials, threshold. For a sweep:
/// parameter, value, pd, pd_low, pd_high, trials, false_alarms, hours, false_alarms_per_hour and its interval,
/// latency_s and its interval (empty where nothing was detected), threshold.
void writeCurve(const Campaign &campaign, const std::string &path);

/// The points of such a file, in order. Throws Error naming the file and line.
std::vector<CurvePoint> readCurve(const std::string &path);

/// Does the given runs of an experiment, keeping every finished one in `path` + ".part": a later call with the same
/// experiment takes them from there, even after a kill. The file is removed by the caller that writes the final result
/// (`removeParts`).
Campaign carryOutResumably(const Experiment &experiment, const std::vector<int> &runs, const std::string &path,
                           const RunContext &context = {});
void removeParts(const std::string &path);

} // namespace faintline
