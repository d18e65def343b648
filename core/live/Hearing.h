#pragma once

#include "base/Axis.h"
#include "live/ListenSettings.h"
#include "live/StreamBuffer.h"

#include <atomic>
#include <chrono>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace faintline {

/// Measures how far a source's clock, given by its sample count, has drifted from this machine's.
///
/// Samples may arrive late and in bursts, but never early: the least late delivery of each ten seconds is compared with
/// that of the first ten. A departure is reported when it reaches 0.1 s, and again each time it doubles. Times are not
/// corrected: a recording keeps the source's time.
class SourceClock
{
public:
    explicit SourceClock(double sampleRateHz) : m_rate(sampleRateHz) { restart(); }

    struct Departure {
        Index samples = 0; ///< by which this machine's clock leads the source's; negative: source leads
        double ppm = 0.0;  ///< the same, relative to the elapsed time
        std::string words; ///< one sentence
    };

    /// Takes the number of samples counted, lost ones included, at time `seconds` of this machine's clock.
    std::optional<Departure> note(Index counted, double seconds);
    /// Starts over, after an interruption of the source.
    void restart();

private:
    struct ClockInterval {
        double begin = 0.0;
        double leastLate = 0.0; ///< s
        double at = 0.0;        ///< time of the least late delivery
    };

    std::optional<Departure> departureIn(const ClockInterval &interval);

    double m_rate;
    std::optional<ClockInterval> m_first; ///< once complete
    std::optional<ClockInterval> m_current;
    double m_worthTelling; ///< next departure to report, s
};

/// The thread that reads a source, writes each sample to disk and then to the buffer, at its position in time.
class Hearing
{
public:
    using Tell = std::function<void(ListenNotice)>;

    /// Starts the thread. `source`, `buffer` and `settings` must outlive this object; the thread calls `tell`.
    Hearing(SampleSource &source, StreamBuffer &buffer, const ListenSettings &settings, std::stop_token stop,
            Tell tell);
    ~Hearing() { finish(); }

    /// Stops the thread and waits for it to end. Results are final after that.
    void finish();

    /// Time of the first sample; empty before it arrives.
    std::optional<double> startUnixSeconds() const;
    Index lostCount() const { return m_lostCount; }
    bool isRecordedWhole() const { return m_isRecordedWhole; }
    const std::vector<std::string> &files() const { return m_files; }
    const std::string &whole() const { return m_whole; }
    /// The recording in progress; null before its first sample or if nothing is recorded.
    std::shared_ptr<const WrittenSamples> written() const;
    /// The exception that the source threw, or null.
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
    mutable std::mutex m_startMutex; ///< guards m_start and m_written
    Index m_position = 0;            ///< position in time of the next sample
    Index m_missing = 0;             ///< samples lost since the last ones received
    Index m_overflown = 0;           ///< of these, lost because the buffer was full
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
