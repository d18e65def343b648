#pragma once

#include "base/Axis.h"

#include <string>
#include <vector>

#include <sys/types.h>

namespace faintline {

/// Runs a program for each of many events, without a shell and without waiting for it: its arguments are those given
/// and, last, the event's line.
///
/// At most 16 run at a time; calls beyond that are left out and counted. Their input is empty, their output goes where
/// this program's errors go. Used by one thread at a time.
class EventCommand
{
public:
    /// `words`: program and arguments, at least one.
    explicit EventCommand(std::vector<std::string> words) : m_words(std::move(words)) {}
    ~EventCommand();
    EventCommand(const EventCommand &) = delete;
    EventCommand &operator=(const EventCommand &) = delete;

    /// Throws Error where there is no such program.
    void run(const std::string &line);

    Index leftOutCount() const { return m_leftOutCount; }

private:
    void forgetEnded();

    std::vector<std::string> m_words;
    std::vector<pid_t> m_running;
    Index m_leftOutCount = 0;
};

} // namespace faintline
