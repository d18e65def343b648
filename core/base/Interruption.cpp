#include "base/Interruption.h"

#include "base/temporaries.h"

#include <csignal>
#include <cstdlib>
#include <string_view>

#include <unistd.h>

namespace faintline {

namespace {

    sigset_t bothSignals()
    {
        sigset_t signals;
        sigemptyset(&signals);
        sigaddset(&signals, SIGINT);
        sigaddset(&signals, SIGTERM);
        return signals;
    }

} // namespace

Interruption::Interruption(std::chrono::milliseconds patience) : m_patience(patience)
{
    const sigset_t signals = bothSignals();
    pthread_sigmask(SIG_BLOCK, &signals, nullptr);
    m_thread = std::thread([this] { wait(); });
}

Interruption::~Interruption()
{
    {
        const std::lock_guard lock(m_guard);
        m_isOver = true;
    }
    m_ended.notify_all();
    pthread_kill(m_thread.native_handle(), SIGTERM); // wakes it where it waits for a signal
    m_thread.join();
}

void Interruption::wait()
{
    const sigset_t signals = bothSignals();
    int signal = 0;
    while (sigwait(&signals, &signal) != 0) {
    }
    {
        const std::lock_guard lock(m_guard);
        if (m_isOver)
            return;
    }
    m_stop.request_stop();
    std::unique_lock lock(m_guard);
    if (m_ended.wait_for(lock, m_patience, [this] { return m_isOver; }))
        return;
    removeTemporaries();
    constexpr std::string_view message = "error: interrupted: nothing half-written is left\n";
    (void)!::write(STDERR_FILENO, message.data(), message.size());
    std::_Exit(1);
}

} // namespace faintline
