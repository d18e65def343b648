#pragma once

#include "base/Axis.h"

#include <string>
#include <vector>

#include <sys/types.h>

namespace faintline {

/// Runs a program for each event, without a shell and without waiting for it to exit. The event's line is appended to
/// the given arguments.
///
/// At most 16 run at a time; further calls are skipped and counted. Standard input is empty; the output goes to this
/// program's standard error. Not thread-safe.
class EventCommand
{
public:
    /// `words`: program and arguments, at least one.
    explicit EventCommand(std::vector<std::string> words) : m_words(std::move(words)) {}
    ~EventCommand();
    EventCommand(const EventCommand &) = delete;
    EventCommand &operator=(const EventCommand &) = delete;

    /// Throws Error if the program cannot be started.
    void run(const std::string &line);

    Index leftOutCount() const { return m_leftOutCount; }

private:
    void forgetEnded();

    std::vector<std::string> m_words;
    std::vector<pid_t> m_running;
    Index m_leftOutCount = 0;
};

} // namespace faintline
