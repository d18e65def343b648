#pragma once

#include "plan/AnalysisSettings.h"
#include "signal/openRecording.h"

#include <string>

namespace faintline {

/// Settings for reading and analysing all recordings of a survey.
struct SurveySettings {
    AnalysisSettings analysis;
    OpenOptions open;
};

/// Settings and program of a survey. Surveys whose origins differ in the shard only can be merged.
struct SurveyOrigin {
    std::string settings;     ///< JSON of those that differ from the defaults
    std::string reading;      ///< JSON of the OpenOptions
    std::string version;      ///< of the program
    std::string calibrations; ///< their version (plan/calibrationVersion.h)
    std::string shard;        ///< "2/8": part of the recordings (base/Shard.h); empty: all

    bool operator==(const SurveyOrigin &) const = default;
};

/// The origin of a survey by this program.
SurveyOrigin originOf(const SurveySettings &settings, const std::string &shard = {});

/// The settings of an existing survey. Throws Error naming `where`.
SurveySettings settingsOf(const SurveyOrigin &origin, const std::string &where);

/// Throws Error naming the first difference between an existing survey and the wanted one.
void checkOrigin(const SurveyOrigin &there, const SurveyOrigin &wanted, const std::string &path);

} // namespace faintline
