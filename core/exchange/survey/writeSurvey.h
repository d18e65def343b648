#pragma once

#include "exchange/survey/SurveyDatabase.h"

#include <string>
#include <vector>

namespace faintline {

/// Writes the content of several surveys as one, with the recordings in the order of their paths: the same content
/// gives the same bytes. The file appears under its name only when it is complete; it may be one of the parts. Throws
/// Error if a recording is in two parts.
void writeSurvey(const std::vector<SurveyDatabase *> &parts, const SurveyOrigin &origin, const std::string &path);

/// Writes a survey without recordings, unfinished.
void beginSurvey(const SurveyOrigin &origin, const std::string &path);

/// Merges the shards of a survey, in any order. Throws Error if they differ in their origin, one is unfinished or
/// missing, or `out` is a survey with reviews.
void mergeSurveys(const std::vector<std::string> &paths, const std::string &out);

} // namespace faintline
