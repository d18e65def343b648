#pragma once

#include "exchange/survey/Sqlite.h"
#include "exchange/survey/SurveyOrigin.h"
#include "exchange/survey/SurveyOutcome.h"

#include <span>
#include <string>
#include <vector>

namespace faintline {

/// What a file of a survey begins with.
inline constexpr std::size_t surveyHeaderBytes = 72;
bool isSurveyHeader(std::span<const std::byte> header);

/// A survey of recordings in one SQLite file. `writeSurvey` creates one.
///
/// The constructor checks that the file is a survey, and does not change other files. The tables must be exactly those
/// of `surveySchema`, so that an untrusted file can contain neither triggers nor views. Paths below the folder of the
/// database are relative to it. Every call throws Error with the name of the database if it is damaged, contains
/// invalid values, or cannot be written. For one thread at a time; other programs may read the file while a survey adds
/// to it.
/// to it.
class SurveyDatabase
{
public:
    /// `patience`: how long to wait for other programs that use it.
    explicit SurveyDatabase(const std::string &path, Sqlite::Access access = Sqlite::Access::Read,
                            std::chrono::milliseconds patience = std::chrono::seconds(10));

    const std::string &path() const { return m_database.path(); }
    const SurveyOrigin &origin() const { return m_origin; }
    /// Whether the survey is complete.
    bool isFinished();

    /// For readers: all later reads see the file as it is at the first of them; writers wait until the object is
    /// destroyed.
    void hold() { m_database.execute("BEGIN"); }

    std::vector<SurveyRecording> recordings(); ///< by id, which is the order of paths in a finished survey
    std::vector<SurveyEvent> events(std::int64_t recording);
    std::vector<SurveyPoint> points(std::int64_t recording);
    std::vector<AreaEvent> areas(std::int64_t recording);

    // ---- writing; changes between begin and commit are one transaction ---------------------------------------------

    void begin() { m_database.execute("BEGIN IMMEDIATE"); }
    void commit() { m_database.execute("COMMIT"); }
    /// No other program reads or writes until the commit.
    void lock() { m_database.execute("BEGIN EXCLUSIVE"); }

    void setUnfinished();
    /// Replaces all rows of the same path; its reviews are deleted.
    void put(const SurveyOutcome &outcome);
    /// For a file whose date has changed, but not its content.
    void setModified(std::int64_t recording, const SurveyFile &file);
    /// Between begin and commit: stores a person's verdict on an event that was read before. Throws Error if the survey
    /// no longer has the event.
    void setReview(const std::string &recording, const Event &event, Verdict verdict, const std::string &note);

    Sqlite &connection() { return m_database; }

private:
    void checkHeader();
    void check();
    SurveyOrigin readOrigin();

    Sqlite m_database;
    SurveyOrigin m_origin;
};

/// A recording's path as the database stores it, in UTF-8: relative if it lies below the database's folder.
std::string storedPath(const std::string &recording, const std::string &database);

} // namespace faintline
