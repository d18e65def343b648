#pragma once

#include "base/RunContext.h"
#include "base/Shard.h"
#include "exchange/survey/SurveyOrigin.h"

#include <functional>
#include <string>
#include <vector>

namespace faintline {

/// What a survey does.
struct SurveyRun {
    SurveySettings settings;
    std::vector<std::string> recordings; ///< absolute paths of the recordings of all shards, in order
    Shard shard;
    int jobs = 1; ///< recordings analysed at the same time
};

/// Counts of the recordings of a run.
struct SurveyTally {
    int analysed = 0; ///< in this run
    int kept = 0;     ///< unchanged since an earlier run
    int failed = 0;   ///< could not be analysed
};

/// Called for every recording that cannot be analysed.
using SurveyWarning = std::function<void(const std::string &path, const std::string &why)>;

/// Analyses recordings with the same settings and stores the results in the database `out` (SurveyDatabase.h).
///
/// Recordings that have not changed since an earlier run (same length and date, or else same hash) are not analysed
/// again; so a run that was interrupted or killed is resumed, and recordings can be added later. A recording that was
/// analysed before and cannot be read now counts as failed and keeps its rows. The first recording is analysed with all
/// threads, because the others reuse its calibration. Finished recordings are committed every second, or every 50 of
/// them. At the end the database is rewritten in the order of the recordings: its bytes do not depend on jobs, threads,
/// shards (mergeSurveys) or interruptions. Commits wait while
/// another program reads the database.
///
/// `warn` is called by the calling thread. Throws Error if the database cannot be written or has other settings, and
/// Cancelled; what was committed is kept in both cases.
SurveyTally carryOutSurvey(const SurveyRun &run, const std::string &out, const RunContext &context = {},
                           const SurveyWarning &warn = {});

} // namespace faintline
