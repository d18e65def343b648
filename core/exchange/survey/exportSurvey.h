#pragma once

#include "exchange/survey/SurveyDatabase.h"

#include <optional>
#include <string>

namespace faintline {

/// All events as CSV, by recording, then onset: recording, utc_onset (empty where the recording has no start time), the
/// columns of `writeEvents`, f_low, f_high, review, note. Numbers have the digits that `detect` writes; unknown values
/// are empty. Every export appears under its name only when it is complete, and throws Error.
void exportEvents(SurveyDatabase &survey, const std::string &path);

/// All tracks as CSV: recording and the columns of `writeTracks`.
void exportTracks(SurveyDatabase &survey, const std::string &path);

/// The points of all tracks as Stone Soup's CSV readers take them, ordered by time: time (ISO 8601, UTC), frequency_hz,
/// track (unique), recording, t, statistic, snr_db. `startUnixSeconds`: of recordings that have none; without it they
/// are refused.
void exportStoneSoup(SurveyDatabase &survey, const std::string &path, std::optional<double> startUnixSeconds);

/// How events of a recording are written into a file of their own.
enum class SurveyList { Raven, Audacity, Sigmf };

/// For every recording with events a file FOLDER/PATH.selections.txt, .txt or .sigmf-meta, as `writeReviewed` has it.
void exportLists(SurveyDatabase &survey, SurveyList list, const std::string &folder);

/// A recording's path without a root and without ways up: what may be made below a folder, whoever wrote the survey.
std::string pathBelow(const std::string &recording, const std::string &database);

} // namespace faintline
