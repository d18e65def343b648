#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>

#include <pthread.h>

namespace faintline {

/// Ctrl+C and SIGTERM, from its construction on: they ask what runs to stop. What has not stopped within the patience
/// (it waits for a pipe, it reads something large) is ended all the same, with exit code 1, after what is half-written
/// was removed.
///
/// Construct it before any other thread is started: those that come later leave the two signals to the one that waits
/// for them here. Where there is no room for that one, they end the program as they do by themselves.
class Interruption
{
public:
    static constexpr std::chrono::milliseconds usualPatience{500};

    explicit Interruption(std::chrono::milliseconds patience = usualPatience);
    ~Interruption();
    Interruption(const Interruption &) = delete;
    Interruption &operator=(const Interruption &) = delete;

    std::stop_token token() const { return m_stop.get_token(); }

private:
    void wait();

    std::chrono::milliseconds m_patience;
    std::stop_source m_stop;
    std::mutex m_guard;
    std::condition_variable m_ended;
    bool m_isOver = false;
    pthread_t m_thread = {};
    bool m_isWaiting = false;
};

} // namespace faintline
