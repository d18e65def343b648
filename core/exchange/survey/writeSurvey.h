#pragma once

#include "exchange/survey/SurveyDatabase.h"

#include <string>
#include <vector>

namespace faintline {

/// Writes the content of surveys as one, its recordings in order of their paths: the same content gives the same bytes,
/// however it came about. The file appears when it is complete; it may be one of the parts. Throws Error where a
/// recording is in two parts.
void writeSurvey(const std::vector<SurveyDatabase *> &parts, const SurveyOrigin &origin, const std::string &path);

/// A survey without recordings, to which some will be added.
void beginSurvey(const SurveyOrigin &origin, const std::string &path);

/// The shards of a survey, in any order, as one. Throws Error where they are not of one origin, not finished, one is
/// missing, or `out` is a survey with reviews.
void mergeSurveys(const std::vector<std::string> &paths, const std::string &out);

} // namespace faintline
