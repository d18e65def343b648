#include "app/cli/EventCommand.h"

#include "base/Error.h"

#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

namespace faintline {

namespace {

    constexpr std::size_t mostRunning = 16;

    /// Resets signal handling for the child: this program's threads block some signals.
    class FreshSignals
    {
    public:
        FreshSignals()
        {
            sigset_t none;
            sigemptyset(&none);
            posix_spawnattr_init(&m_attributes);
            posix_spawnattr_setsigmask(&m_attributes, &none);
            posix_spawnattr_setflags(&m_attributes, POSIX_SPAWN_SETSIGMASK);
        }
        ~FreshSignals() { posix_spawnattr_destroy(&m_attributes); }
        FreshSignals(const FreshSignals &) = delete;
        FreshSignals &operator=(const FreshSignals &) = delete;
        const posix_spawnattr_t *get() const { return &m_attributes; }

    private:
        posix_spawnattr_t m_attributes;
    };

    class Streams
    {
    public:
        Streams()
        {
            posix_spawn_file_actions_init(&m_actions);
            posix_spawn_file_actions_addopen(&m_actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
            posix_spawn_file_actions_adddup2(&m_actions, STDERR_FILENO, STDOUT_FILENO);
        }
        ~Streams() { posix_spawn_file_actions_destroy(&m_actions); }
        Streams(const Streams &) = delete;
        Streams &operator=(const Streams &) = delete;
        const posix_spawn_file_actions_t *get() const { return &m_actions; }

    private:
        posix_spawn_file_actions_t m_actions;
    };

} // namespace

EventCommand::~EventCommand()
{
    forgetEnded(); // programs still running are not terminated
}

void EventCommand::forgetEnded()
{
    std::erase_if(m_running, [](pid_t process) { return ::waitpid(process, nullptr, WNOHANG) != 0; });
}

void EventCommand::run(const std::string &line)
{
    forgetEnded();
    if (m_running.size() >= mostRunning) {
        ++m_leftOutCount;
        return;
    }
    std::vector<std::string> words = m_words;
    words.push_back(line);
    std::vector<char *> arguments;
    for (std::string &word : words)
        arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const FreshSignals signals;
    const Streams streams;
    pid_t process = 0;
    if (const int reason =
            ::posix_spawnp(&process, arguments[0], streams.get(), signals.get(), arguments.data(), environ))
        throw Error("--on-event " + m_words.front(), std::string("cannot be run: ") + std::strerror(reason));
    m_running.push_back(process);
}

} // namespace faintline
