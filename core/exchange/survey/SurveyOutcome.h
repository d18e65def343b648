#pragma once

#include "analyse/events.h"
#include "inspect/Review.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// The file of a recording when it was analysed; for a recording in two files (SigMF), both together.
struct SurveyFile {
    std::string path;          ///< absolute
    std::int64_t bytes = 0;    ///< length
    std::int64_t modified = 0; ///< ns since 1970-01-01 UTC
    std::string hash;          ///< see signal/fileHash.h; two hashes are joined by "+"
};

/// One recording of a survey: its properties, and the settings of its analysis or the reason why it failed.
struct SurveyRecording {
    std::int64_t id = 0; ///< its number in the database
    SurveyFile file;
    std::string reason; ///< why it could not be analysed; empty if it was
    std::string container;
    std::optional<double> sampleRateHz; ///< empty for files that contain frames
    std::optional<double> durationSeconds;
    std::optional<double> centreHz;
    std::optional<double> startUnixSeconds;
    std::string settings; ///< of its analysis, JSON; with the chosen window where the survey leaves it open
    std::optional<double> windowSeconds;
    std::optional<double> threshold; ///< in `unit`
    std::string unit;                ///< of the statistic
    std::optional<double> lnK;

    bool isAnalysed() const { return reason.empty(); }
};

/// One event, with the box of its track in time and frequency and its review.
struct SurveyEvent {
    Event event;
    Annotation box;
};

/// One frame of a track: the values of `surveyTrackColumns`, that is t, f, statistic, f_low, f_high, presence, snr_db;
/// NaN where the track was not smoothed.
struct SurveyPoint {
    int track = 0;
    std::array<double, 7> values{};
};

/// All that a survey stores for one recording.
struct SurveyOutcome {
    SurveyRecording recording;
    std::vector<SurveyEvent> events; ///< by onset, then frequency
    std::vector<SurveyPoint> points; ///< by track, then time
    std::vector<AreaEvent> areas;    ///< by onset, then frequency
};

} // namespace faintline
