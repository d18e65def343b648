#pragma once

#include "base/RunContext.h"
#include "exchange/survey/SurveyOrigin.h"

#include <functional>
#include <string>
#include <vector>

namespace faintline {

/// Part `index` of `count` of a survey: the recordings with number ≡ index (mod count). 0 and count name the same.
struct SurveyShard {
    int index = 0;
    int count = 1;

    bool isWhole() const { return count == 1; }
    std::string name() const; ///< "2/8"; empty for the whole
};

/// What a survey does.
struct SurveyRun {
    SurveySettings settings;
    std::vector<std::string> recordings; ///< whole paths of all of them, in order, whatever the shard
    SurveyShard shard;
    int jobs = 1; ///< recordings analysed at a time
};

/// What became of the recordings of a survey.
struct SurveyTally {
    int analysed = 0; ///< now
    int kept = 0;     ///< were in the database already, unchanged
    int failed = 0;   ///< could not be analysed
};

/// Is told of every recording that cannot be analysed.
using SurveyWarning = std::function<void(const std::string &path, const std::string &why)>;

/// Analyses recordings with the same settings into the database `out` (SurveyDatabase.h).
///
/// What the database has already of files that have not changed (length and date, or else their hash) is kept; so a run
/// that was interrupted or killed at any moment goes on where it was, and recordings may be added later. A
/// recording that was analysed and cannot be read for the moment counts as failed, but its rows stay. The first
/// recording is analysed by all threads, because it calibrates for the others. Every second, or every 50 of them, the
/// finished ones are committed. At the end the database is written anew in the order of the recordings: its bytes do
/// not depend on jobs, threads, shards (mergeSurveys) or interruptions.
///
/// `warn` is called by the calling thread. Throws Error, where the database cannot be written or was made from other
/// settings, and Cancelled, with all finished recordings kept.
SurveyTally carryOutSurvey(const SurveyRun &run, const std::string &out, const RunContext &context = {},
                           const SurveyWarning &warn = {});

} // namespace faintline
