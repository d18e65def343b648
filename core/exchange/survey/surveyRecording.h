#pragma once

#include "base/RunContext.h"
#include "exchange/survey/SurveyOrigin.h"
#include "exchange/survey/SurveyOutcome.h"

#include <string>

namespace faintline {

/// Length and date of a recording's file, or of both its files; without the hash. A missing file has length 0.
SurveyFile fileOf(const std::string &path, const SurveySettings &settings);

/// The hash of the file; empty if it cannot be read.
std::string hashOf(const SurveyFile &file, const SurveySettings &settings);

/// Analyses one recording of a survey as `detect` does. If that fails, the outcome contains the reason. Throws only
/// Cancelled.
SurveyOutcome surveyRecording(const SurveyFile &file, const SurveySettings &settings, const RunContext &context);

} // namespace faintline
