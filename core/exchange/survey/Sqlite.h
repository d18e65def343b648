#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace faintline {

/// A prepared statement of an SQLite database. Values go to its question marks in order; columns count from 0. NaN and
/// an empty optional are NULL.
class SqliteStatement
{
public:
    /// Begins again with these values.
    template <class... Values>
    SqliteStatement &with(const Values &...values)
    {
        reset();
        int place = 0;
        (bind(++place, values), ...);
        return *this;
    }

    /// Goes to the next row; false after the last. Throws Error, also where there are more rows than the file can hold.
    bool next();

    /// Executes the statement with these values and discards its rows.
    template <class... Values>
    void run(const Values &...values)
    {
        with(values...);
        while (next()) {
        }
    }

    void bind(int place, double value);
    void bind(int place, std::int64_t value);
    void bind(int place, int value) { bind(place, std::int64_t(value)); }
    void bind(int place, const std::string &text);
    void bind(int place, const std::optional<double> &value);
    /// The value of another statement's column in its present row.
    void bindColumn(int place, const SqliteStatement &from, int column);

    int columnCount() const;
    bool isNull(int column) const;
    std::int64_t integer(int column) const;
    double number(int column) const; ///< NaN of NULL
    std::optional<double> optionalNumber(int column) const;
    std::string text(int column) const; ///< empty of NULL

    void reset();

private:
    friend class Sqlite;
    struct Finalise {
        void operator()(sqlite3_stmt *statement) const;
    };

    SqliteStatement(sqlite3 *database, const std::string &path, std::string_view sql, std::int64_t mostRows);
    void check(int code) const;

    sqlite3 *m_database;
    std::string m_path;
    std::unique_ptr<sqlite3_stmt, Finalise> m_statement;
    std::int64_t m_mostRows;
    std::int64_t m_rows = 0; ///< since it began
};

/// A connection to an SQLite database file, closed with the object; errors of the library become Error, with the file's
/// name. For one thread at a time. Files from untrusted sources may be opened: the schema is not trusted, no text may
/// be longer than 64 MiB, and pages that lead back to themselves give an Error, not rows without end.
class Sqlite
{
public:
    enum class Access {
        Read,  ///< of a file that exists; what a killed program left half-written is rolled back
        Write, ///< of a file that exists
        Fill   ///< of a temporary file that nobody else knows: without locks and journal
    };

    /// `patience`: with other programs that use the file.
    Sqlite(const std::string &path, Access access, std::chrono::milliseconds patience = std::chrono::seconds(10));

    SqliteStatement prepare(std::string_view sql);
    void execute(std::string_view sql) { prepare(sql).run(); }
    /// The first column of the only row of a query.
    std::int64_t integer(std::string_view sql);

    const std::string &path() const { return m_path; }

private:
    struct Close {
        void operator()(sqlite3 *database) const;
    };

    std::string m_path;
    std::unique_ptr<std::int64_t> m_steps; ///< millions of steps that a reader may still make
    std::unique_ptr<sqlite3, Close> m_database;
};

} // namespace faintline
