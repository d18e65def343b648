#include "exchange/survey/SurveyDatabase.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "exchange/survey/surveySchema.h"
#include "signal/formats/bytes.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <string_view>
#include <utility>

namespace faintline {

namespace fs = std::filesystem;

namespace {

    constexpr std::string_view databaseMagic("SQLite format 3\0", 16);

    fs::path folderOf(const std::string &database)
    {
        return fs::absolute(database).lexically_normal().parent_path();
    }

    std::string absolutePath(const std::string &stored, const fs::path &folder)
    {
        return (folder / fileNameFromText(stored)).lexically_normal().string();
    }

    constexpr const char *otherTables = "is not a survey: its tables differ from those in docs/reference/survey.md";

    /// A finite number of a row.
    double number(const SqliteStatement &row, int column, const std::string &path)
    {
        const double value = row.number(column);
        if (!std::isfinite(value))
            throw Error(path, "contains a number that is missing or not finite");
        return value;
    }

    double numberOf(const SqliteStatement &row, int column, bool isOptional, const std::string &path)
    {
        return isOptional ? row.number(column) : number(row, column, path);
    }

    /// Binds the cells of a row after a place; returns the last one's place.
    template <class Row>
    int bindCells(SqliteStatement &statement, int place, const std::vector<TableColumn<Row>> &columns, const Row &row)
    {
        for (const TableColumn<Row> &column : columns)
            std::visit([&](const auto &value) { statement.bind(++place, value); }, column.value(row));
        return place;
    }

    int whole(const SqliteStatement &row, int column, const std::string &path)
    {
        const std::int64_t value = row.integer(column);
        if (!std::in_range<int>(value))
            throw Error(path, "contains an event or track number that is too large");
        return int(value);
    }

} // namespace

std::string storedPath(const std::string &recording, const std::string &database)
{
    const fs::path relative = fs::path(recording).lexically_relative(folderOf(database));
    const bool isBelow = !relative.empty() && *relative.begin() != "..";
    return textFromFileName(isBelow ? relative.string() : recording);
}

bool isSurveyHeader(std::span<const std::byte> header)
{
    return header.size() == surveyHeaderBytes && asText(header).starts_with(databaseMagic)
           && std::int64_t(bigEndian(header.last(4))) == surveyApplicationId;
}

// ---- reading -------------------------------------------------------------------------------------------------------

SurveyDatabase::SurveyDatabase(const std::string &path, Sqlite::Access access, std::chrono::milliseconds patience)
    : m_database(path, access, patience)
{
    checkHeader();
    check();
    m_origin = readOrigin();
}

/// Call before the first transaction: reading a database with a write-ahead log, left by another program, changes it.
void SurveyDatabase::checkHeader()
{
    std::array<std::byte, surveyHeaderBytes> header{};
    const std::size_t bytes = m_database.readBeginning(header);
    if (bytes > 0 && !asText(header).starts_with(databaseMagic))
        throw Error(path(), "is not an SQLite database");
    const bool hasLog = header[18] != std::byte(1) || header[19] != std::byte(1);
    if (hasLog || !isSurveyHeader(std::span(header).first(bytes)))
        throw Error(path(), "is not a survey; 'faintline-cli survey' creates surveys");
}

void SurveyDatabase::check()
{
    if (const auto format = m_database.integer("PRAGMA user_version"); format != surveyFormat)
        throw Error(path(), "is a survey in format " + std::to_string(format) + "; this program reads format "
                                + std::to_string(surveyFormat));
    // Objects that SQLite adds itself: indexes for unique columns, and statistics for queries.
    SqliteStatement objects =
        m_database.prepare("SELECT coalesce(sql, '') FROM sqlite_schema WHERE NOT (type = 'index' AND sql IS NULL) "
                           "AND NOT (type = 'table' AND name IN ('sqlite_stat1', 'sqlite_stat4')) ORDER BY rowid");
    std::size_t alike = 0;
    while (objects.next())
        if (alike == surveySchema().size() || objects.text(0) != surveySchema()[alike++])
            throw Error(path(), otherTables);
    if (alike < surveySchema().size())
        throw Error(path(), otherTables);
}

SurveyOrigin SurveyDatabase::readOrigin()
{
    SurveyOrigin origin;
    SqliteStatement settings = m_database.prepare("SELECT settings, reading, version FROM settings");
    if (!settings.next())
        throw Error(path(), "is not a survey: it contains no settings");
    origin.settings = settings.text(0);
    origin.reading = settings.text(1);
    origin.version = settings.text(2);
    SqliteStatement provenance = m_database.prepare("SELECT key, value FROM provenance");
    while (provenance.next()) {
        if (provenance.text(0) == "calibrations")
            origin.calibrations = provenance.text(1);
        if (provenance.text(0) == "shard")
            origin.shard = provenance.text(1);
    }
    return origin;
}

bool SurveyDatabase::isFinished()
{
    return m_database.integer("SELECT count(*) FROM provenance WHERE key = 'unfinished'") == 0;
}

std::vector<SurveyRecording> SurveyDatabase::recordings()
{
    const fs::path folder = folderOf(path());
    std::vector<SurveyRecording> result;
    SqliteStatement row =
        m_database.prepare("SELECT id, path, " + surveyRecordingColumns + " FROM recordings ORDER BY id");
    while (row.next()) {
        const std::int64_t id = row.integer(0);
        if (!result.empty() && id <= result.back().id)
            throw Error(path(), "is a damaged SQLite database");
        SurveyRecording &one = result.emplace_back();
        one.id = id;
        one.file.path = absolutePath(row.text(1), folder);
        one.reason = row.text(2) == "done" ? std::string() : row.text(3);
        if (row.text(2) != "done" && one.reason.empty())
            one.reason = "unknown";
        one.file.bytes = row.integer(4);
        one.file.modified = row.integer(5);
        one.file.hash = row.text(6);
        one.container = row.text(7);
        one.sampleRateHz = row.optionalNumber(8);
        one.durationSeconds = row.optionalNumber(9);
        one.centreHz = row.optionalNumber(10);
        one.startUnixSeconds = row.optionalNumber(11);
        one.settings = row.text(12);
        one.windowSeconds = row.optionalNumber(13);
        one.threshold = row.optionalNumber(14);
        one.unit = row.text(15);
        one.lnK = row.optionalNumber(16);
    }
    return result;
}

std::vector<SurveyEvent> SurveyDatabase::events(std::int64_t recording)
{
    SqliteStatement row = m_database.prepare("SELECT " + surveyTable("events").columns
                                             + ", verdict, note FROM events LEFT JOIN reviews USING (recording, event) "
                                               "WHERE events.recording = ? ORDER BY id");
    row.with(recording);
    std::vector<SurveyEvent> result;
    while (row.next()) {
        SurveyEvent one;
        Event &event = one.event;
        whole(row, 0, path());
        int column = 0;
        for (const TableColumn<Event> &each : surveyEventColumns())
            each.set(event, numberOf(row, column++, each.isOptional, path()));
        event.detectedPosition = event.position;
        event.ratesPerSecond = {event.driftPerSecond};
        one.box.startSeconds = event.onsetSeconds;
        one.box.endSeconds = event.endSeconds;
        one.box.lowHz = number(row, column++, path());
        one.box.highHz = number(row, column++, path());
        one.box.label = "event " + std::to_string(event.id);
        one.box.verdict = verdictNamed(row.text(column++));
        one.box.note = row.text(column);
        result.push_back(std::move(one));
    }
    return result;
}

std::vector<SurveyPoint> SurveyDatabase::points(std::int64_t recording)
{
    SqliteStatement row = m_database.prepare(surveyTable("tracks").query());
    row.with(recording);
    std::vector<SurveyPoint> result;
    while (row.next()) {
        SurveyPoint &point = result.emplace_back(SurveyPoint{whole(row, 0, path()), {}});
        for (std::size_t i = 0; i < point.values.size(); ++i)
            point.values[i] = numberOf(row, int(i) + 2, surveyTrackColumns()[i].isOptional, path());
    }
    return result;
}

std::vector<AreaEvent> SurveyDatabase::areas(std::int64_t recording)
{
    SqliteStatement row = m_database.prepare(surveyTable("areas").query());
    row.with(recording);
    std::vector<AreaEvent> result;
    while (row.next()) {
        AreaEvent &area = result.emplace_back();
        for (int column = 0; const TableColumn<AreaEvent> &each : areaColumns())
            each.set(area, number(row, ++column, path()));
    }
    return result;
}

// ---- writing -------------------------------------------------------------------------------------------------------

void SurveyDatabase::setUnfinished()
{
    m_database.execute("INSERT OR REPLACE INTO provenance(key, value) VALUES ('unfinished', 'yes')");
}

void SurveyDatabase::put(const SurveyOutcome &outcome)
{
    const SurveyRecording &r = outcome.recording;
    const std::string stored = storedPath(r.file.path, path());
    const std::string whole = textFromFileName(r.file.path); // stored so before the database was in a folder above it
    for (const SurveyTable &one : surveyTables())
        m_database
            .prepare("DELETE FROM " + one.name + " WHERE recording IN (SELECT id FROM recordings WHERE path IN (?, ?))")
            .run(stored, whole);
    m_database.prepare("DELETE FROM recordings WHERE path IN (?, ?)").run(stored, whole);
    m_database.prepare(insertionInto("recordings", "path, " + surveyRecordingColumns))
        .run(stored, std::string(r.isAnalysed() ? "done" : "failed"), r.reason, r.file.bytes, r.file.modified,
             r.file.hash, r.container, r.sampleRateHz, r.durationSeconds, r.centreHz, r.startUnixSeconds, r.settings,
             r.windowSeconds, r.threshold, r.unit, r.lnK);
    const std::int64_t id = m_database.integer("SELECT last_insert_rowid()");

    SqliteStatement event = m_database.prepare(surveyTable("events").insertion());
    for (const auto &[e, box] : outcome.events) {
        int place = bindCells(event.with(id), 1, surveyEventColumns(), e);
        event.bind(++place, box.lowHz);
        event.bind(++place, box.highHz);
        event.next();
    }
    SqliteStatement point = m_database.prepare(surveyTable("tracks").insertion());
    std::map<int, int> count;
    for (const SurveyPoint &p : outcome.points) {
        point.with(id, p.track, count[p.track]++);
        for (int place = 3; const double value : p.values)
            point.bind(++place, value);
        point.next();
    }
    SqliteStatement area = m_database.prepare(surveyTable("areas").insertion());
    for (int i = 0; i < std::ssize(outcome.areas); ++i) {
        bindCells(area.with(id, i + 1), 2, areaColumns(), outcome.areas[std::size_t(i)]);
        area.next();
    }
}

void SurveyDatabase::setModified(std::int64_t recording, const SurveyFile &file)
{
    m_database.prepare("UPDATE recordings SET bytes = ?, modified_ns = ? WHERE id = ?")
        .run(file.bytes, file.modified, recording);
}

void SurveyDatabase::setReview(const std::string &recording, const Event &event, Verdict verdict,
                               const std::string &note)
{
    // The numbers of recordings change when recordings are added.
    SqliteStatement there = m_database.prepare("SELECT recordings.id FROM events JOIN recordings ON recordings.id = "
                                               "recording WHERE path IN (?, ?) AND event = ? AND t_onset = ? "
                                               "AND f = ?");
    if (!there
             .with(storedPath(recording, path()), textFromFileName(recording), event.id, event.onsetSeconds,
                   event.position.back())
             .next())
        throw Error(path(), "has changed since it was opened; open it again", Error::Kind::Failure);
    const std::int64_t id = there.integer(0);
    there.reset();
    if (verdict == Verdict::None && note.empty())
        m_database.prepare("DELETE FROM reviews WHERE recording = ? AND event = ?").run(id, event.id);
    else
        m_database.prepare("INSERT OR REPLACE INTO reviews(recording, event, verdict, note) VALUES (?, ?, ?, ?)")
            .run(id, event.id, nameOf(verdict), note);
}

} // namespace faintline
