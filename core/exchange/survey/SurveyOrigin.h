#pragma once

#include "analysis/AnalysisSettings.h"
#include "recording/openRecording.h"

#include <string>

namespace faintline {

/// What all recordings of a survey are read and analysed with.
struct SurveySettings {
    AnalysisSettings analysis;
    OpenOptions open;
};

/// What a survey was made from, besides its recordings. Surveys of one origin, but for the shard, may be merged.
struct SurveyOrigin {
    std::string settings; ///< JSON of those that differ from the defaults
    std::string reading;  ///< JSON of the OpenOptions
    std::string version;  ///< of the program
    std::string sources;  ///< fingerprint of the program's sources (analysis/sourceFingerprint.h)
    std::string shard;    ///< "2/8": only these recordings of the whole; empty: all

    bool operator==(const SurveyOrigin &) const = default;
};

/// The origin of a survey that this program makes.
SurveyOrigin originOf(const SurveySettings &settings, const std::string &shard = {});

/// The settings of a survey that exists. Throws Error naming `where`.
SurveySettings settingsOf(const SurveyOrigin &origin, const std::string &where);

/// Throws Error naming the first thing in which a survey that exists differs from the one wanted.
void checkOrigin(const SurveyOrigin &there, const SurveyOrigin &wanted, const std::string &path);

} // namespace faintline
