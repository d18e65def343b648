#pragma once

#include "exchange/survey/SurveyDatabase.h"

#include <optional>
#include <string>

namespace faintline {

/// Writes all events as CSV, by recording, then onset: recording, utc_onset (empty if the recording has no start time),
/// the columns of `writeEvents`, f_low, f_high, review, note. Numbers have the digits that `detect` writes; unknown
/// values are empty. Every export appears under its name only when it is complete, and throws Error.
void exportEvents(SurveyDatabase &survey, const std::string &path);

/// Writes all tracks as CSV: recording and the columns of `writeTracks`.
void exportTracks(SurveyDatabase &survey, const std::string &path);

/// Writes the points of all tracks in the format of Stone Soup's CSV readers, ordered by time: time (ISO 8601, UTC),
/// frequency_hz, track (unique), recording, t, statistic, snr_db. `startUnixSeconds`: for recordings without a start
/// time, which are otherwise an error.
void exportStoneSoup(SurveyDatabase &survey, const std::string &path, std::optional<double> startUnixSeconds);

/// Format of the event lists of single recordings.
enum class SurveyList { Raven, Audacity, Sigmf };

/// For each recording with events, writes a file FOLDER/PATH.selections.txt, .txt or .sigmf-meta as `writeReviewed`
/// does.
void exportLists(SurveyDatabase &survey, SurveyList list, const std::string &folder);

/// A recording's path without root and parent references, safe to create below a folder even for untrusted surveys.
std::string pathBelow(const std::string &recording, const std::string &database);

/// Location and time of recordings.
struct CamtrapPlace {
    double latitude = 0.0;                  ///< degrees north, WGS 84
    double longitude = 0.0;                 ///< degrees east
    std::optional<double> startUnixSeconds; ///< for recordings without a start time
};

/// Writes a survey as a Camera Trap Data Package, 1.0.2 (https://camtrap-dp.tdwg.org), to a folder: datapackage.json,
/// deployments.csv (one per folder of recordings, from the start of its first recording to the end of its last),
/// media.csv (recordings) and observations.csv (events).
///
/// An event without a review is "unclassified", an accepted one "unknown" and a rejected one "blank". Times are whole
/// seconds, as in the standard; observationTags hold values without a column: f_low, f_high, f (Hz), drift_hz_per_s,
/// statistic, t_onset, t_end (s from the first sample). Recordings that could not be analysed are omitted. Throws Error
/// if a recording has no start time and `place` gives none.
void exportCamtrap(SurveyDatabase &survey, const std::string &folder, const CamtrapPlace &place);

} // namespace faintline
