#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>

#include <pthread.h>

namespace faintline {

/// Handles Ctrl+C and SIGTERM: requests running work to stop. If the program has not ended after the patience time (for
/// example while it waits for a pipe or a large read), removes half-written files and exits with code 1.
///
/// Construct it before starting any thread: later threads leave both signals to the thread that waits for them here. If
/// that thread cannot be started, the signals end the program in their usual way.
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
