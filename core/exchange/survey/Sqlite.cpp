#include "exchange/survey/Sqlite.h"

#include "base/Error.h"

#include <sqlite3.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <thread>
#include <utility>

namespace faintline {

namespace {

    constexpr int longestText = 64 << 20;

    [[noreturn]] void fail(sqlite3 *database, const std::string &path, int code)
    {
        if (code == SQLITE_READONLY_DBMOVED)
            throw Error(path, "was replaced by another program while it was in use", Error::Kind::Failure);
        switch (code & 0xff) {
        case SQLITE_NOMEM:
            throw Error(path, "is a damaged SQLite database, or needs more memory than is available");
        case SQLITE_NOTADB:
            throw Error(path, "is not an SQLite database");
        case SQLITE_CORRUPT:
        case SQLITE_INTERRUPT: // from countSteps
            throw Error(path, "is a damaged SQLite database");
        case SQLITE_BUSY:
        case SQLITE_LOCKED:
            throw Error(path, "is in use by another program", Error::Kind::Failure);
        default:
            throw Error(path, std::string("SQLite: ") + (database ? sqlite3_errmsg(database) : sqlite3_errstr(code)),
                        Error::Kind::Failure);
        }
    }

    constexpr int million = 1'000'000;

    int countSteps(void *left)
    {
        return --*static_cast<std::int64_t *>(left) < 0 ? 1 : 0;
    }

    std::int64_t bytesOf(const std::string &path)
    {
        std::error_code code;
        const auto bytes = std::filesystem::file_size(path, code);
        return code ? 0 : std::int64_t(bytes);
    }

    /// SQLite treats names such as ":memory:" specially, but no absolute path.
    std::string wholePath(const std::string &path)
    {
        std::error_code code;
        const bool isFile = std::filesystem::is_regular_file(path, code);
        if (!isFile)
            throw Error(path, std::filesystem::exists(path, code) ? "is not a file; expected a survey, .sqlite"
                                                                  : "there is no such file");
        return std::filesystem::absolute(path).string();
    }

} // namespace

// ---- statements ----------------------------------------------------------------------------------------------------

void SqliteStatement::Finalise::operator()(sqlite3_stmt *statement) const
{
    sqlite3_finalize(statement);
}

SqliteStatement::SqliteStatement(sqlite3 *database, const std::string &path, std::string_view sql,
                                 std::int64_t mostRows)
    : m_database(database), m_path(path), m_mostRows(mostRows)
{
    sqlite3_stmt *statement = nullptr;
    check(sqlite3_prepare_v2(database, sql.data(), int(sql.size()), &statement, nullptr));
    m_statement.reset(statement);
}

void SqliteStatement::check(int code) const
{
    if (code != SQLITE_OK)
        fail(m_database, m_path, code);
}

bool SqliteStatement::next()
{
    const int code = sqlite3_step(m_statement.get());
    if (code == SQLITE_ROW && ++m_rows > m_mostRows)
        fail(m_database, m_path, SQLITE_CORRUPT);
    if (code == SQLITE_ROW)
        return true;
    if (code != SQLITE_DONE)
        fail(m_database, m_path, code);
    reset();
    return false;
}

void SqliteStatement::reset()
{
    sqlite3_reset(m_statement.get());
    m_rows = 0;
}

void SqliteStatement::bind(int place, double value)
{
    check(sqlite3_bind_double(m_statement.get(), place, value));
}

void SqliteStatement::bind(int place, std::int64_t value)
{
    check(sqlite3_bind_int64(m_statement.get(), place, value));
}

void SqliteStatement::bind(int place, const std::string &text)
{
    check(sqlite3_bind_text64(m_statement.get(), place, text.data(), text.size(), SQLITE_TRANSIENT, SQLITE_UTF8));
}

void SqliteStatement::bind(int place, const std::optional<double> &value)
{
    check(value ? sqlite3_bind_double(m_statement.get(), place, *value) : sqlite3_bind_null(m_statement.get(), place));
}

void SqliteStatement::bindColumn(int place, const SqliteStatement &from, int column)
{
    check(sqlite3_bind_value(m_statement.get(), place, sqlite3_column_value(from.m_statement.get(), column)));
}

int SqliteStatement::columnCount() const
{
    return sqlite3_column_count(m_statement.get());
}

bool SqliteStatement::isNull(int column) const
{
    return sqlite3_column_type(m_statement.get(), column) == SQLITE_NULL;
}

std::int64_t SqliteStatement::integer(int column) const
{
    return sqlite3_column_int64(m_statement.get(), column);
}

double SqliteStatement::number(int column) const
{
    return isNull(column) ? std::nan("") : sqlite3_column_double(m_statement.get(), column);
}

std::optional<double> SqliteStatement::optionalNumber(int column) const
{
    return isNull(column) ? std::nullopt : std::optional(sqlite3_column_double(m_statement.get(), column));
}

std::string SqliteStatement::text(int column) const
{
    const unsigned char *text = sqlite3_column_text(m_statement.get(), column);
    const int bytes = sqlite3_column_bytes(m_statement.get(), column);
    return text ? std::string(reinterpret_cast<const char *>(text), std::size_t(bytes)) : std::string();
}

// ---- connections ---------------------------------------------------------------------------------------------------

void Sqlite::Close::operator()(sqlite3 *database) const
{
    sqlite3_close_v2(database);
}

Sqlite::Sqlite(const std::string &path, Access access, std::chrono::milliseconds patience) : m_path(path)
{
    // A reader may have to roll back the transaction of a killed program, and therefore to write.
    const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
    sqlite3 *database = nullptr;
    const int code =
        sqlite3_open_v2(wholePath(path).c_str(), &database, flags, access == Access::Fill ? "unix-none" : nullptr);
    m_database.reset(database);
    if (code != SQLITE_OK)
        fail(database, path, code);
    sqlite3_busy_timeout(database, int(patience.count()));
    sqlite3_limit(database, SQLITE_LIMIT_LENGTH, longestText);
    if (access == Access::Fill) {
        execute("PRAGMA journal_mode = OFF");
        execute("PRAGMA synchronous = OFF");
        return;
    }
    sqlite3_db_config(database, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
    sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
    execute("PRAGMA cell_size_check = ON");
    if (access == Access::Write)
        return;
    execute("PRAGMA query_only = ON");
    // All exports of a survey together take some hundred steps per row, and a row takes about ten bytes.
    m_steps = std::make_unique<std::int64_t>(20 + bytesOf(path) / 10'000);
    sqlite3_progress_handler(database, million, countSteps, m_steps.get());
}

void Sqlite::waitWhile(std::function<bool()> goesOn)
{
    m_goesOn = std::make_unique<std::function<bool()>>(std::move(goesOn));
    const auto ask = [](void *function, int) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        return (*static_cast<std::function<bool()> *>(function))() ? 1 : 0;
    };
    sqlite3_busy_handler(m_database.get(), ask, m_goesOn.get());
}

std::size_t Sqlite::readBeginning(std::span<std::byte> out)
{
    sqlite3_file *file = nullptr;
    sqlite3_int64 size = 0;
    int code = sqlite3_file_control(m_database.get(), "main", SQLITE_FCNTL_FILE_POINTER, &file);
    if (code == SQLITE_OK)
        code = file->pMethods->xFileSize(file, &size);
    const std::size_t count = std::min(out.size(), std::size_t(size));
    if (code == SQLITE_OK)
        code = file->pMethods->xRead(file, out.data(), int(count), 0);
    if (code != SQLITE_OK)
        fail(m_database.get(), m_path, code);
    return count;
}

SqliteStatement Sqlite::prepare(std::string_view sql)
{
    constexpr std::int64_t shortestRow = 8;
    return SqliteStatement(m_database.get(), m_path, sql, 1000 + bytesOf(m_path) / shortestRow);
}

std::int64_t Sqlite::integer(std::string_view sql)
{
    SqliteStatement statement = prepare(sql);
    return statement.next() ? statement.integer(0) : 0;
}

} // namespace faintline
