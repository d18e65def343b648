#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
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
    /// Resets the statement and binds these values.
    template <class... Values>
    SqliteStatement &with(const Values &...values)
    {
        reset();
        int place = 0;
        (bind(++place, values), ...);
        return *this;
    }

    /// Steps to the next row; false after the last one. Throws Error, also where there are more rows than the file can
    /// hold.
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
    /// Binds the value of a column in another statement's current row.
    void bindColumn(int place, const SqliteStatement &from, int column);

    int columnCount() const;
    bool isNull(int column) const;
    std::int64_t integer(int column) const;
    double number(int column) const; ///< NaN for NULL
    std::optional<double> optionalNumber(int column) const;
    std::string text(int column) const; ///< empty for NULL

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
    std::int64_t m_rows = 0; ///< since the last reset
};

/// A connection to an SQLite database file; the destructor closes it. Errors of the library are thrown as Error with
/// the name of the file. For one thread at a time. Files from untrusted sources may be opened: the schema is not
/// trusted, a text may have at most 64 MiB, and pages that refer to each other in a cycle give an Error instead of
/// endless rows.
class Sqlite
{
public:
    enum class Access {
        Read,  ///< an existing file; a transaction that a killed program left is rolled back
        Write, ///< an existing file
        Fill   ///< a temporary file that no other program uses: without locks and journal
    };

    /// `patience`: how long to wait for other programs that use the file.
    Sqlite(const std::string &path, Access access, std::chrono::milliseconds patience = std::chrono::seconds(10));

    SqliteStatement prepare(std::string_view sql);
    void execute(std::string_view sql) { prepare(sql).run(); }
    /// The first column of the only row of a query.
    std::int64_t integer(std::string_view sql);

    /// Waits for other programs as long as `goesOn` answers true, and asks it every 20 ms.
    void waitWhile(std::function<bool()> goesOn);
    /// Reads the first bytes of the file from disk and returns their number. Uses the connection, because closing a
    /// separate descriptor would release all locks of the process (POSIX).
    std::size_t readBeginning(std::span<std::byte> out);

    const std::string &path() const { return m_path; }

private:
    struct Close {
        void operator()(sqlite3 *database) const;
    };

    std::string m_path;
    std::unique_ptr<std::int64_t> m_steps; ///< millions of steps left to a reader
    std::unique_ptr<std::function<bool()>> m_goesOn;
    std::unique_ptr<sqlite3, Close> m_database;
};

} // namespace faintline
