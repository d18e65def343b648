#pragma once

#include "analysis/Review.h"
#include "analysis/events.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// The file of a recording as it was when it was analysed; of a recording in two files (SigMF), both together.
struct SurveyFile {
    std::string path;          ///< absolute
    std::int64_t bytes = 0;    ///< length
    std::int64_t modified = 0; ///< ns since 1970-01-01 UTC
    std::string hash;          ///< as recording/fileHash.h makes it; of two files both, "+" between them
};

/// One recording of a survey: what it is, and what it was analysed with or why it could not be.
struct SurveyRecording {
    std::int64_t id = 0; ///< its number in the database
    SurveyFile file;
    std::string reason; ///< why it could not be analysed; empty: it was
    std::string container;
    std::optional<double> sampleRateHz; ///< nothing of files that hold frames
    std::optional<double> durationSeconds;
    std::optional<double> centreHz;
    std::optional<double> startUnixSeconds;
    std::string settings; ///< those used, JSON: with the window chosen, where the survey's leave it open
    std::optional<double> windowSeconds;
    std::optional<double> threshold; ///< in `unit`
    std::string unit;                ///< of the statistic
    std::optional<double> lnK;

    bool isAnalysed() const { return reason.empty(); }
};

/// One event, and what its track fills in time and frequency with what a person said of it.
struct SurveyEvent {
    Event event;
    Annotation box;
};

/// One frame of a track, as `writeTracks` has it; NaN where the track was not looked at from both ends.
struct SurveyPoint {
    int track = 0;
    double seconds = 0.0;
    double position = 0.0; ///< Hz
    double statistic = 0.0;
    double low = 0.0;
    double high = 0.0;
    double presence = 0.0;
    double snrDb = 0.0;
};

/// All that a survey keeps of one recording.
struct SurveyOutcome {
    SurveyRecording recording;
    std::vector<SurveyEvent> events; ///< by onset, then frequency
    std::vector<SurveyPoint> points; ///< by track, then time
    std::vector<AreaEvent> areas;    ///< by onset, then frequency
};

} // namespace faintline
