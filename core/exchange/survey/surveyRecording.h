#pragma once

#include "base/RunContext.h"
#include "exchange/survey/SurveyOrigin.h"
#include "exchange/survey/SurveyOutcome.h"

#include <string>

namespace faintline {

/// Length and date of a recording's file, or of both its files; without the hash. A file that is not there is empty.
SurveyFile fileOf(const std::string &path, const SurveySettings &settings);

/// Its hash; empty where it cannot be read.
std::string hashOf(const SurveyFile &file, const SurveySettings &settings);

/// Analyses one recording of a survey as `detect` does; what cannot be analysed has the reason in its outcome. Throws
/// nothing but Cancelled.
SurveyOutcome surveyRecording(const SurveyFile &file, const SurveySettings &settings, const RunContext &context);

} // namespace faintline
