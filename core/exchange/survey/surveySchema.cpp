#include "exchange/survey/surveySchema.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr const char *settingsTable = R"(CREATE TABLE settings (
    id INTEGER PRIMARY KEY CHECK (id = 1),
    settings TEXT NOT NULL,
    reading TEXT NOT NULL,
    version TEXT NOT NULL
) STRICT)";

    constexpr const char *provenanceTable = R"(CREATE TABLE provenance (
    key TEXT PRIMARY KEY,
    value TEXT NOT NULL
) STRICT, WITHOUT ROWID)";

    constexpr const char *recordingsTable = R"(CREATE TABLE recordings (
    id INTEGER PRIMARY KEY,
    path TEXT NOT NULL UNIQUE,
    status TEXT NOT NULL CHECK (status IN ('done', 'failed')),
    reason TEXT NOT NULL,
    bytes INTEGER NOT NULL,
    modified_ns INTEGER NOT NULL,
    hash TEXT NOT NULL,
    container TEXT NOT NULL,
    sample_rate_hz REAL,
    duration_s REAL,
    centre_hz REAL,
    start_unix_s REAL,
    settings TEXT NOT NULL,
    window_s REAL,
    threshold REAL,
    statistic_unit TEXT NOT NULL,
    ln_k REAL
) STRICT)";

    constexpr const char *eventsTable = R"(CREATE TABLE events (
    id INTEGER PRIMARY KEY,
    recording INTEGER NOT NULL REFERENCES recordings (id),
    event INTEGER NOT NULL,
    t_onset REAL NOT NULL,
    t_detect REAL NOT NULL,
    t_end REAL NOT NULL,
    f REAL NOT NULL,
    drift_hz_per_s REAL NOT NULL,
    statistic REAL NOT NULL,
    confirmed INTEGER NOT NULL,
    open INTEGER NOT NULL,
    snr_db REAL,
    band_hz REAL,
    noise_probability REAL,
    window_s REAL,
    f_low REAL NOT NULL,
    f_high REAL NOT NULL,
    UNIQUE (recording, event)
) STRICT)";

    constexpr const char *tracksTable = R"(CREATE TABLE tracks (
    recording INTEGER NOT NULL REFERENCES recordings (id),
    track INTEGER NOT NULL,
    point INTEGER NOT NULL,
    t REAL NOT NULL,
    f REAL NOT NULL,
    statistic REAL NOT NULL,
    f_low REAL,
    f_high REAL,
    presence REAL,
    snr_db REAL,
    PRIMARY KEY (recording, track, point)
) STRICT, WITHOUT ROWID)";

    constexpr const char *areasTable = R"(CREATE TABLE areas (
    recording INTEGER NOT NULL REFERENCES recordings (id),
    area INTEGER NOT NULL,
    t_onset REAL NOT NULL,
    t_end REAL NOT NULL,
    f_low REAL NOT NULL,
    f_high REAL NOT NULL,
    level_db REAL NOT NULL,
    PRIMARY KEY (recording, area)
) STRICT, WITHOUT ROWID)";

    constexpr const char *reviewsTable = R"(CREATE TABLE reviews (
    recording INTEGER NOT NULL REFERENCES recordings (id),
    event INTEGER NOT NULL,
    verdict TEXT NOT NULL CHECK (verdict IN ('', 'accepted', 'rejected')),
    note TEXT NOT NULL,
    PRIMARY KEY (recording, event)
) STRICT, WITHOUT ROWID)";

} // namespace

const std::string surveyRecordingColumns =
    "status, reason, bytes, modified_ns, hash, container, sample_rate_hz, duration_s, centre_hz, start_unix_s, "
    "settings, window_s, threshold, statistic_unit, ln_k";

const std::vector<std::string> &surveySchema()
{
    static const std::vector<std::string> schema{settingsTable, provenanceTable, recordingsTable, eventsTable,
                                                 tracksTable,   areasTable,      reviewsTable};
    return schema;
}

const std::vector<SurveyTable> &surveyTables()
{
    static const std::vector<SurveyTable> tables{
        {"events",
         "event, t_onset, t_detect, t_end, f, drift_hz_per_s, statistic, confirmed, open, snr_db, band_hz, "
         "noise_probability, window_s, f_low, f_high",
         "id"},
        {"tracks", "track, point, t, f, statistic, f_low, f_high, presence, snr_db", "track, point"},
        {"areas", "area, t_onset, t_end, f_low, f_high, level_db", "area"},
        {"reviews", "event, verdict, note", "event"}};
    return tables;
}

const SurveyTable &surveyTable(const std::string &name)
{
    return *std::find_if(surveyTables().begin(), surveyTables().end(),
                         [&](const SurveyTable &table) { return table.name == name; });
}

std::string insertionInto(const std::string &name, const std::string &columns)
{
    std::string marks = "?";
    for (auto i = std::count(columns.begin(), columns.end(), ','); i > 0; --i)
        marks += ", ?";
    return "INSERT INTO " + name + "(" + columns + ") VALUES (" + marks + ")";
}

std::string SurveyTable::insertion() const
{
    return insertionInto(name, "recording, " + columns);
}

std::string SurveyTable::query() const
{
    return "SELECT " + columns + " FROM " + name + " WHERE recording = ? ORDER BY " + order;
}

} // namespace faintline
