#pragma once

#include "analyse/columns.h"

#include <cstdint>
#include <string>
#include <vector>

namespace faintline {

/// Header fields of the file: PRAGMA application_id and user_version.
inline constexpr std::int64_t surveyApplicationId = 0x4674'6c6e; // "Ftln"
inline constexpr std::int64_t surveyFormat = 1;

/// The columns that a survey has of an event, before those of its track's band (f_low, f_high), and of a track's point.
const std::vector<TableColumn<Event>> &surveyEventColumns();
const std::vector<TableColumn<TrackPlace>> &surveyTrackColumns();

/// The statements that create the tables of a survey, in order (docs/reference/survey.md).
const std::vector<std::string> &surveySchema();

/// A table whose rows belong to recordings.
struct SurveyTable {
    std::string name;
    std::string columns; ///< following that of the recording
    std::string order;   ///< of its rows

    /// "INSERT INTO …", with a question mark for the recording and each of the columns.
    std::string insertion() const;
    /// "SELECT columns …" for one recording, in order.
    std::string query() const;
};
const std::vector<SurveyTable> &surveyTables();
/// The table of that name, which must exist.
const SurveyTable &surveyTable(const std::string &name);

/// The columns of a recording after its id and path.
extern const std::string surveyRecordingColumns;

/// "INSERT INTO NAME(COLUMNS) VALUES (?, ?, …)"
std::string insertionInto(const std::string &name, const std::string &columns);

} // namespace faintline
