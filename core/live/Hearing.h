#pragma once

#include "live/ListenSettings.h"
#include "live/SourceClock.h"
#include "live/StreamBuffer.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

namespace faintline {

/// The thread that hears a source: to disk first, then to the buffer, every sample at its place in time.
class Hearing
{
public:
    using Tell = std::function<void(ListenNotice)>;

    /// Begins. `source`, `buffer` outlive this; `tell` is called from the thread.
    Hearing(SampleSource &source, StreamBuffer &buffer, const ListenSettings &settings, std::stop_token stop,
            Tell tell);
    ~Hearing() { finish(); }

    /// Stops it and waits for its end. What is known is final after that.
    void finish();

    /// The first sample's time, once there is one.
    std::optional<double> startUnixSeconds() const;
    Index lostCount() const { return m_lostCount; }
    bool isRecordedWhole() const { return m_isRecordedWhole; }
    const std::vector<std::string> &files() const { return m_files; }
    const std::string &whole() const { return m_whole; }
    /// What is being recorded, once there is a sample of it; null where nothing is.
    std::shared_ptr<const WrittenSamples> written() const;
    /// What the source failed with; null where it did not.
    std::exception_ptr failure() const { return m_failure; }

private:
    void run(const std::stop_token &own);
    void take(Heard heard);
    bool makeRoom(std::size_t bytes);
    void begin(Index samples);
    void record(std::span<const std::byte> bytes);
    void noteFiles();
    void watchDisk();
    void watchClock(Index samples);
    void tell(ListenNotice::Kind kind, Index samples, std::string words);

    SampleSource &m_source;
    StreamBuffer &m_buffer;
    const ListenSettings &m_settings;
    std::stop_token m_stop;
    std::stop_token m_own; ///< of the thread
    Tell m_tell;
    std::unique_ptr<SigmfRecorder> m_recorder;
    std::optional<double> m_start;
    std::shared_ptr<const WrittenSamples> m_written;
    mutable std::mutex m_startMutex; ///< of these two
    Index m_position = 0;            ///< in time, of the next sample
    Index m_missing = 0;             ///< samples lost since the last ones that were heard
    Index m_overflown = 0;           ///< of them, for want of room
    std::atomic<Index> m_lostCount = 0;
    SourceClock m_clock;
    bool m_isRecordedWhole = true;
    bool m_hasWarned = false;
    std::chrono::steady_clock::time_point m_diskWatched{};
    std::vector<std::string> m_files;
    std::string m_whole;
    std::exception_ptr m_failure;
    std::jthread m_thread;
};

} // namespace faintline
