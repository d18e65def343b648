#pragma once

#include "evaluate/experiments/campaignCurve.h"

#include <string>

namespace faintline {

/// A campaign's runs on disk: a line with the experiment, then one line of JSON per run. Shards are exchanged, and
/// interrupted campaigns resumed, in this format. Reading ignores a truncated last line.
///
///   {"faintlineCampaign": 1, "experiment": {…}, "thresholds": […]}
///   {"run": 0, "noise": [[…]], "signal": [[[…]]]}
void writeCampaign(const Campaign &campaign, const std::string &path);

/// Throws Error naming the file and line.
Campaign readCampaign(const std::string &path);

/// Whether the file's first line identifies a campaign.
bool isCampaignFile(const std::string &path);

/// Whether the file's first line is that of a curve of Pd (writeCurve).
bool isCurveFile(const std::string &path);

/// Writes detection probabilities as CSV: detector, snr_db, pd, pd_low, pd_high (95 %), trials, threshold
/// (`shownThreshold`). For a sweep:
/// parameter, value, pd, pd_low, pd_high, trials, false_alarms, hours, false_alarms_per_hour and its interval,
/// latency_s and its interval (empty if nothing was detected), threshold.
void writeCurve(const Campaign &campaign, const std::string &path);

/// Writes the operating characteristics of all detectors at one SNR as CSV: detector, snr_db, threshold,
/// false_alarms_per_block (or false_alarm_probability of an injection's path), pd, pd_low, pd_high (95 %). A sweep
/// has none: its false alarms are in its curve.
void writeRoc(const Campaign &campaign, std::size_t snr, const std::string &path);

/// Reads the points of a curve, in order. Throws Error naming the file and line.
std::vector<CurvePoint> readCurve(const std::string &path);

/// Executes the given runs of an experiment and stores each finished one in `path` + ".part", from which a later call
/// with the same experiment resumes, even after a kill. The caller that writes the final result removes the file
/// (`removeParts`).
Campaign carryOutResumably(const Experiment &experiment, const std::vector<int> &runs, const std::string &path,
                           const RunContext &context = {});
void removeParts(const std::string &path);

} // namespace faintline
