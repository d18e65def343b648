#pragma once

#include <stdexcept>
#include <string>

namespace faintline {

/// A refusal a user can act on: what went wrong, where, and why or what would be accepted instead.
///
/// Thrown at edges only (opening, parsing, checking settings). Shown as one line, `where: why`.
class Error : public std::runtime_error
{
public:
    /// Mistake: the user can put it right (exit code 2). Failure: the machine's doing (exit code 1).
    enum class Kind { Mistake, Failure };

    Error(std::string where, std::string why, Kind kind = Kind::Mistake)
        : std::runtime_error(where + ": " + why), m_where(std::move(where)), m_why(std::move(why)), m_kind(kind)
    {
    }

    const std::string &where() const { return m_where; }
    const std::string &why() const { return m_why; }
    Kind kind() const { return m_kind; }

    /// The name of the setting or member that is wrong, as its table has it; empty where it is none. Forms mark it.
    const std::string &field() const { return m_field; }
    Error ofField(std::string name) const
    {
        Error error = *this;
        error.m_field = std::move(name);
        return error;
    }

    /// The same, farther away: `place: where: why`.
    Error in(const std::string &place) const { return Error(place + ": " + m_where, m_why, m_kind).ofField(m_field); }

private:
    std::string m_where;
    std::string m_why;
    Kind m_kind;
    std::string m_field;
};

/// Thrown by a long computation whose RunContext was asked to stop; its partial results are discarded.
class Cancelled : public std::exception
{
public:
    const char *what() const noexcept override { return "cancelled"; }
};

} // namespace faintline
