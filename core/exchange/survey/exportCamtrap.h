#pragma once

#include "exchange/survey/SurveyDatabase.h"

#include <optional>
#include <string>

namespace faintline {

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
