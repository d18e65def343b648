#include "exchange/survey/surveySchema.h"

#include "exchange/csvText.h"

#include <algorithm>
#include <cstring>

namespace faintline {

namespace {

    Grid frequencyGrid()
    {
        return {{{"frequency", "Hz", 0.0, 1.0, 1, false}}};
    }

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

    /// A row of CREATE TABLE for each column.
    template <class Row>
    std::string definitions(const std::vector<TableColumn<Row>> &columns)
    {
        std::string text;
        for (const TableColumn<Row> &column : columns)
            text += "    " + column.name + (std::holds_alternative<double>(column.kind) ? " REAL" : " INTEGER")
                    + (column.isOptional ? ",\n" : " NOT NULL,\n");
        return text;
    }

    /// The statement that creates a table with such rows, where `text` has "…".
    std::string tableOf(std::string text, const std::string &rows)
    {
        return text.replace(text.find("    …\n"), std::strlen("    …\n"), rows);
    }

    constexpr const char *eventsTable = R"(CREATE TABLE events (
    id INTEGER PRIMARY KEY,
    recording INTEGER NOT NULL REFERENCES recordings (id),
    …
    f_low REAL NOT NULL,
    f_high REAL NOT NULL,
    UNIQUE (recording, event)
) STRICT)";

    constexpr const char *tracksTable = R"(CREATE TABLE tracks (
    recording INTEGER NOT NULL REFERENCES recordings (id),
    track INTEGER NOT NULL,
    point INTEGER NOT NULL,
    …
    PRIMARY KEY (recording, track, point)
) STRICT, WITHOUT ROWID)";

    constexpr const char *areasTable = R"(CREATE TABLE areas (
    recording INTEGER NOT NULL REFERENCES recordings (id),
    area INTEGER NOT NULL,
    …
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

const std::vector<TableColumn<Event>> &surveyEventColumns()
{
    static const auto columns = eventColumns(frequencyGrid(), {.secondPass = true});
    return columns;
}

const std::vector<TableColumn<TrackPlace>> &surveyTrackColumns()
{
    static const auto columns = trackColumns(frequencyGrid(), {.secondPass = true});
    return columns;
}

const std::vector<std::string> &surveySchema()
{
    static const std::vector<std::string> schema{settingsTable,
                                                 provenanceTable,
                                                 recordingsTable,
                                                 tableOf(eventsTable, definitions(surveyEventColumns())),
                                                 tableOf(tracksTable, definitions(surveyTrackColumns())),
                                                 tableOf(areasTable, definitions(areaColumns())),
                                                 reviewsTable};
    return schema;
}

const std::vector<SurveyTable> &surveyTables()
{
    static const std::vector<SurveyTable> tables{
        {"events", csvNames(surveyEventColumns()) + ",f_low,f_high", "id"},
        {"tracks", "track,point," + csvNames(surveyTrackColumns()), "track, point"},
        {"areas", "area," + csvNames(areaColumns()), "area"},
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
