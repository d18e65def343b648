// Stands in for Sqlite.cpp where SQLite is not installed: there are no surveys.

#include "base/Error.h"
#include "exchange/survey/Sqlite.h"

namespace faintline {

Sqlite::Sqlite(const std::string &path, Access, std::chrono::milliseconds)
{
    throw Error(path, "surveys need SQLite, without which this Faintline was built (libsqlite3)");
}

// What follows is never called: there is no object of these classes.
void Sqlite::Close::operator()(sqlite3 *) const {}
SqliteStatement Sqlite::prepare(std::string_view sql)
{
    return {nullptr, m_path, sql, 0};
}
std::int64_t Sqlite::integer(std::string_view)
{
    return 0;
}
void Sqlite::waitWhile(std::function<bool()>) {}
std::size_t Sqlite::readBeginning(std::span<std::byte>)
{
    return 0;
}

void SqliteStatement::Finalise::operator()(sqlite3_stmt *) const {}
SqliteStatement::SqliteStatement(sqlite3 *database, const std::string &path, std::string_view, std::int64_t mostRows)
    : m_database(database), m_path(path), m_mostRows(mostRows)
{
}
bool SqliteStatement::next()
{
    return false;
}
void SqliteStatement::bind(int, double) {}
void SqliteStatement::bind(int, std::int64_t) {}
void SqliteStatement::bind(int, const std::string &) {}
void SqliteStatement::bind(int, const std::optional<double> &) {}
void SqliteStatement::bindColumn(int, const SqliteStatement &, int) {}
int SqliteStatement::columnCount() const
{
    return 0;
}
bool SqliteStatement::isNull(int) const
{
    return true;
}
std::int64_t SqliteStatement::integer(int) const
{
    return 0;
}
double SqliteStatement::number(int) const
{
    return 0.0;
}
std::optional<double> SqliteStatement::optionalNumber(int) const
{
    return {};
}
std::string SqliteStatement::text(int) const
{
    return {};
}
void SqliteStatement::reset() {}

} // namespace faintline
