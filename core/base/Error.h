#pragma once

#include <stdexcept>
#include <string>

namespace faintline {

/// An error the user can act on: what went wrong, where, and why, or what would be accepted.
///
/// Thrown at edges only (opening, parsing, checking settings). Shown as one line, `where: why`.
class Error : public std::runtime_error
{
public:
    /// Mistake: the user can correct it (exit code 2). Failure: caused by the machine (exit code 1).
    enum class Kind { Mistake, Failure };

    Error(std::string where, std::string why, Kind kind = Kind::Mistake)
        : std::runtime_error(where + ": " + why), m_where(std::move(where)), m_why(std::move(why)), m_kind(kind)
    {
    }

    const std::string &where() const { return m_where; }
    const std::string &why() const { return m_why; }
    Kind kind() const { return m_kind; }

    /// Name of the invalid setting or member, as in its table, which forms mark; empty if the error concerns none.
    const std::string &field() const { return m_field; }
    Error ofField(std::string name) const
    {
        Error error = *this;
        error.m_field = std::move(name);
        return error;
    }

    /// The same error with an outer location: `place: where: why`.
    Error in(const std::string &place) const { return Error(place + ": " + m_where, m_why, m_kind).ofField(m_field); }

private:
    std::string m_where;
    std::string m_why;
    Kind m_kind;
    std::string m_field;
};

/// Calls `make` and tells of errors in it that they are in that file.
template <class Make>
auto inFile(const std::string &path, const Make &make)
{
    try {
        return make();
    } catch (const Error &error) {
        throw error.in(path);
    }
}

/// Thrown by a long computation that was asked to stop through its RunContext; partial results are discarded.
class Cancelled : public std::exception
{
public:
    const char *what() const noexcept override { return "cancelled"; }
};

} // namespace faintline
