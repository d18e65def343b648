#include "exchange/survey/writeSurvey.h"

#include "base/Error.h"
#include "base/files/AtomicFile.h"
#include "exchange/survey/surveySchema.h"

#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

namespace faintline {

namespace {

    /// Copies the rows of a query, each preceded by the number of its recording.
    void copyRows(SqliteStatement &from, SqliteStatement &to, std::int64_t recording)
    {
        while (from.next()) {
            to.with(recording);
            for (int column = 0; column < from.columnCount(); ++column)
                to.bindColumn(column + 2, from, column);
            to.next();
        }
    }

    /// Fills the new database.
    class Filling
    {
    public:
        Filling(const std::string &path, const SurveyOrigin &origin) : m_out(path, Sqlite::Access::Fill)
        {
            m_out.execute("PRAGMA application_id = " + std::to_string(surveyApplicationId));
            m_out.execute("PRAGMA user_version = " + std::to_string(surveyFormat));
            m_out.execute("BEGIN");
            for (const std::string &sql : surveySchema())
                m_out.execute(sql);
            m_out.prepare("INSERT INTO settings VALUES (1, ?, ?, ?)")
                .run(origin.settings, origin.reading, origin.version);
            SqliteStatement provenance = m_out.prepare("INSERT INTO provenance VALUES (?, ?)");
            provenance.run(std::string("program"), "Faintline " + origin.version);
            provenance.run(std::string("calibrations"), origin.calibrations);
            if (!origin.shard.empty())
                provenance.run(std::string("shard"), origin.shard);
            m_recording.emplace(m_out.prepare(insertionInto("recordings", "id, path, " + surveyRecordingColumns)));
            for (const SurveyTable &table : surveyTables())
                m_insertions.push_back(m_out.prepare(table.insertion()));
        }

        /// Adds the next recording: its rows from another database, and its path relative to the new one.
        void add(Sqlite &from, std::int64_t there, const std::string &path)
        {
            ++m_id;
            SqliteStatement row = from.prepare("SELECT " + surveyRecordingColumns + " FROM recordings WHERE id = ?");
            row.with(there).next();
            m_recording->with(m_id, path);
            for (int column = 0; column < row.columnCount(); ++column)
                m_recording->bindColumn(column + 3, row, column);
            m_recording->next();
            for (std::size_t i = 0; i < m_insertions.size(); ++i) {
                SqliteStatement rows = from.prepare(surveyTables()[i].query());
                copyRows(rows.with(there), m_insertions[i], m_id);
            }
        }

        void markUnfinished() { m_out.execute("INSERT INTO provenance VALUES ('unfinished', 'yes')"); }
        void commit() { m_out.execute("COMMIT"); }

    private:
        Sqlite m_out;
        std::optional<SqliteStatement> m_recording;
        std::vector<SqliteStatement> m_insertions; ///< one per table, in their order
        std::int64_t m_id = 0;
    };

    /// Position of a recording in one of several databases.
    struct DatabasePlace {
        SurveyDatabase *part;
        std::int64_t id;
    };

    std::map<std::string, DatabasePlace> placesIn(const std::vector<SurveyDatabase *> &parts)
    {
        std::map<std::string, DatabasePlace> places;
        for (SurveyDatabase *part : parts)
            for (const SurveyRecording &one : part->recordings())
                if (const auto [there, isNew] = places.emplace(one.file.path, DatabasePlace{part, one.id}); !isNew)
                    throw Error(part->path(), "contains " + one.file.path + ", which is also in "
                                                  + there->second.part->path()
                                                  + "; a recording may be in one shard only");
        return places;
    }

    /// Throws Error if some but not all shards of a survey are present.
    void checkShards(const std::set<std::string> &shards, const std::string &out)
    {
        for (const std::string &shard : shards) {
            const std::size_t slash = shard.find('/');
            if (slash == std::string::npos)
                continue;
            const std::string count = shard.substr(slash);
            for (int index = 0; index < std::atoi(count.c_str() + 1); ++index)
                if (const std::string wanted = std::to_string(index) + count; !shards.contains(wanted))
                    throw Error(out, "shard " + wanted + " is missing");
        }
    }

    /// Reviews are a person's work, which a merge cannot reproduce.
    void checkHasNoReviews(const std::string &path)
    {
        std::error_code code;
        if (!std::filesystem::is_regular_file(path, code) || std::filesystem::file_size(path, code) == 0)
            return;
        if (SurveyDatabase(path).connection().integer("SELECT EXISTS (SELECT 1 FROM reviews)") != 0)
            throw Error(path, "contains reviews, which the merged survey would replace; choose another name");
    }

} // namespace

void writeSurvey(const std::vector<SurveyDatabase *> &parts, const SurveyOrigin &origin, const std::string &path)
{
    const std::map<std::string, DatabasePlace> places = placesIn(parts);
    AtomicFile file(path);
    try {
        Filling filling(file.temporaryPath(), origin);
        for (const auto &[recording, place] : places)
            filling.add(place.part->connection(), place.id, storedPath(recording, path));
        filling.commit();
    } catch (const Error &error) {
        if (error.where() != file.temporaryPath())
            throw;
        throw Error(path, error.why(), error.kind());
    }
    file.commit();
}

void beginSurvey(const SurveyOrigin &origin, const std::string &path)
{
    AtomicFile file(path);
    {
        Filling filling(file.temporaryPath(), origin);
        filling.markUnfinished();
        filling.commit();
    }
    file.commit();
}

void mergeSurveys(const std::vector<std::string> &paths, const std::string &out)
{
    std::vector<std::unique_ptr<SurveyDatabase>> opened;
    std::vector<SurveyDatabase *> parts;
    std::set<std::string> shards;
    for (const std::string &path : paths) {
        parts.push_back(opened.emplace_back(std::make_unique<SurveyDatabase>(path)).get());
        if (!parts.back()->isFinished())
            throw Error(path, "is not finished; run the survey again to complete it");
        SurveyOrigin origin = parts.front()->origin();
        origin.shard = parts.back()->origin().shard;
        checkOrigin(parts.back()->origin(), origin, path);
        shards.insert(origin.shard);
    }
    checkShards(shards, out);
    checkHasNoReviews(out);
    SurveyOrigin origin = parts.front()->origin();
    origin.shard.clear();
    writeSurvey(parts, origin, out);
}

} // namespace faintline
