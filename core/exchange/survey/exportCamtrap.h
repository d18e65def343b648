#pragma once

#include "exchange/survey/SurveyDatabase.h"

#include <optional>
#include <string>

namespace faintline {

/// Where and when recordings were made.
struct CamtrapPlace {
    double latitude = 0.0;                  ///< degrees north, WGS 84
    double longitude = 0.0;                 ///< degrees east
    std::optional<double> startUnixSeconds; ///< of recordings that have no start time
};

/// A survey as a Camera Trap Data Package, 1.0.2 (https://camtrap-dp.tdwg.org), in a folder: datapackage.json,
/// deployments.csv (every folder of recordings is one, from the start of its first recording to the end of its last),
/// media.csv (recordings) and observations.csv (events).
///
/// An event without a review is "unclassified", an accepted one "unknown" and a rejected one "blank". Times are whole
/// seconds, as the standard has them; observationTags hold what it has no columns for: f_low, f_high, f (Hz),
/// drift_hz_per_s, statistic, t_onset, t_end (s from the first sample). Recordings that could not be analysed are left
/// out. Throws Error where a recording has no start time and `place` gives none.
void exportCamtrap(SurveyDatabase &survey, const std::string &folder, const CamtrapPlace &place);

} // namespace faintline
