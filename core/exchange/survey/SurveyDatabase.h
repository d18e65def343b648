#pragma once

#include "exchange/survey/Sqlite.h"
#include "exchange/survey/SurveyOrigin.h"
#include "exchange/survey/SurveyOutcome.h"

#include <string>
#include <vector>

namespace faintline {

/// A survey of recordings in one SQLite file. `writeSurvey` makes one.
///
/// Opening checks that the file is a survey, and changes no other one: the tables must be those of `surveySchema`, to the letter, so that a
/// stranger's file can hold neither triggers nor views. Paths below the folder of the database are relative to it.
/// Every call throws Error naming the database: where it is damaged, holds values that cannot be, or cannot be written.
/// For one thread at a time; any number of programs may read one, also while a survey adds to it.
class SurveyDatabase
{
public:
    /// `patience`: with other programs that use it.
    explicit SurveyDatabase(const std::string &path, Sqlite::Access access = Sqlite::Access::Read,
                            std::chrono::milliseconds patience = std::chrono::seconds(10));

    const std::string &path() const { return m_database.path(); }
    const SurveyOrigin &origin() const { return m_origin; }
    /// Whether the survey that writes it has come to its end.
    bool isFinished();

    /// Until the object goes, all that is read is of one moment; who writes has to wait.
    void hold() { m_database.execute("BEGIN"); }

    std::vector<SurveyRecording> recordings(); ///< by id: in order of their paths where the survey is finished
    std::vector<SurveyEvent> events(std::int64_t recording);
    std::vector<SurveyPoint> points(std::int64_t recording);
    std::vector<AreaEvent> areas(std::int64_t recording);

    // ---- writing: several changes between begin and commit are one --------------------------------------------------

    void begin() { m_database.execute("BEGIN IMMEDIATE"); }
    void commit() { m_database.execute("COMMIT"); }
    /// Until the commit nobody else reads or writes.
    void lock() { m_database.execute("BEGIN EXCLUSIVE"); }

    void setUnfinished();
    /// In place of what there was of the same path; its reviews go.
    void put(const SurveyOutcome &outcome);
    /// The file's date has changed, but not its content.
    void setModified(std::int64_t recording, const SurveyFile &file);
    /// What a person says of an event that was read here before. Throws Error where the survey has it no more.
    void setReview(const std::string &recording, const Event &event, Verdict verdict, const std::string &note);

    Sqlite &connection() { return m_database; }

private:
    void check();
    SurveyOrigin readOrigin();

    Sqlite m_database;
    SurveyOrigin m_origin;
};

/// A recording's path as a database has it: relative to the database's folder where it lies below it, in UTF-8.
std::string storedPath(const std::string &recording, const std::string &database);

} // namespace faintline
