#include "app/cli/Interruption.h"

#include "base/files/temporaries.h"

#include <csignal>
#include <cstddef>
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
    // A small stack, because all of it counts towards a limited address space.
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, std::size_t(256) << 10);
    const auto work = [](void *self) -> void * {
        static_cast<Interruption *>(self)->wait();
        return nullptr;
    };
    m_isWaiting = pthread_create(&m_thread, &attributes, work, this) == 0;
    pthread_attr_destroy(&attributes);
    if (!m_isWaiting)
        pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
}

Interruption::~Interruption()
{
    if (!m_isWaiting)
        return;
    {
        const std::lock_guard lock(m_guard);
        m_isOver = true;
    }
    m_ended.notify_all();
    // Wakes it from waiting for a signal, which it receives by sigwait.
    pthread_kill(m_thread, SIGTERM); // NOLINT(bugprone-bad-signal-to-kill-thread)
    pthread_join(m_thread, nullptr);
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
    constexpr std::string_view message = "error: interrupted: no incomplete output was left\n";
    (void)!::write(STDERR_FILENO, message.data(), message.size());
    std::_Exit(1);
}

} // namespace faintline
