#include "live/Hearing.h"

#include "base/Error.h"
#include "base/Field.h"

#include <cmath>
#include <cstdio>
#include <utility>

namespace faintline {

namespace {

    constexpr std::chrono::milliseconds pollPatience{50}; ///< maximum delay of a stop request
    constexpr std::chrono::seconds diskInterval{5};
    constexpr double diskWarningSeconds = 600.0;

    double now()
    {
        return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
    }

    constexpr double intervalSeconds = 10.0;
    constexpr double leastSeconds = 0.1; ///< smallest departure reported

} // namespace

Hearing::Hearing(SampleSource &source, StreamBuffer &buffer, const ListenSettings &settings, std::stop_token stop,
                 Tell tell)
    : m_source(source), m_buffer(buffer), m_settings(settings), m_stop(std::move(stop)), m_tell(std::move(tell)),
      m_clock(buffer.format().sampleRateHz), m_thread([this](const std::stop_token &own) { run(own); })
{
}

void Hearing::finish()
{
    m_thread.request_stop();
    if (m_thread.joinable())
        m_thread.join();
}

std::optional<double> Hearing::startUnixSeconds() const
{
    const std::lock_guard lock(m_startMutex);
    return m_start;
}

std::shared_ptr<const WrittenSamples> Hearing::written() const
{
    const std::lock_guard lock(m_startMutex);
    return m_written;
}

void Hearing::run(const std::stop_token &own)
{
    m_own = own;
    try {
        for (bool isOver = false; !isOver && !own.stop_requested() && !m_stop.stop_requested();) {
            Heard heard = m_source.hear(pollPatience);
            isOver = heard.isOver;
            take(std::move(heard));
        }
    } catch (...) {
        m_failure = std::current_exception();
    }
    noteFiles();
    m_buffer.end();
}

void Hearing::noteFiles()
{
    if (!m_recorder)
        return;
    m_files = m_recorder->files();
    m_whole = m_recorder->whole();
}

void Hearing::tell(ListenNotice::Kind kind, Index samples, std::string words)
{
    m_tell({kind, m_position, samples, std::move(words)});
}

void Hearing::take(Heard heard)
{
    using Kind = ListenNotice::Kind;
    if (m_position > 0)
        m_missing += heard.lostSamples; // time starts with the first sample
    if (heard.incident == Heard::Incident::Gone)
        tell(Kind::Gone, 0, heard.words);
    if (heard.incident == Heard::Incident::Back) {
        tell(Kind::Back, m_missing, heard.words);
        m_clock.restart(); // the gap was measured with it
    }
    if (heard.incident == Heard::Incident::Lost)
        tell(Kind::Lost, heard.lostSamples, heard.words);
    const Index samples = std::ssize(heard.bytes) / m_buffer.format().frameBytes();
    if (samples == 0)
        return;
    if (m_position == 0)
        begin(samples);
    watchClock(samples);
    if (!makeRoom(heard.bytes.size())) {
        m_missing += samples;
        m_overflown += samples;
        return;
    }
    if (m_overflown > 0)
        tell(Kind::Overflow, m_overflown, "The analysis fell behind; samples were lost.");
    if (m_missing > 0) {
        m_buffer.pushGap(m_missing);
        if (m_recorder)
            m_recorder->skip(m_missing);
        m_position += m_missing;
        m_lostCount += m_missing;
        m_missing = m_overflown = 0;
    }
    record(heard.bytes);
    m_position += samples;
    m_buffer.push(std::move(heard.bytes));
}

bool Hearing::makeRoom(std::size_t bytes)
{
    if (!m_source.isPatient())
        return m_buffer.hasRoom(bytes, std::chrono::milliseconds(0));
    while (!m_buffer.hasRoom(bytes, pollPatience))
        if (m_stop.stop_requested() || m_own.stop_requested())
            return false;
    return true;
}

void Hearing::begin(Index samples)
{
    const double start = now() - double(samples) / m_buffer.format().sampleRateHz;
    if (!m_settings.recordPath.empty())
        m_recorder =
            std::make_unique<SigmfRecorder>(m_settings.recordPath, m_buffer.format(), m_settings.rotation, start);
    const std::lock_guard lock(m_startMutex);
    m_start = start;
    if (m_recorder)
        m_written = m_recorder->written();
}

void Hearing::record(std::span<const std::byte> bytes)
{
    if (!m_recorder)
        return;
    watchDisk();
    try {
        m_recorder->write(bytes);
    } catch (const Error &error) { // listening continues
        noteFiles();
        m_recorder.reset();
        m_isRecordedWhole = false;
        tell(ListenNotice::Kind::RecordingFailed, 0, std::string("Recording stopped: ") + error.what());
    }
}

/// Called when samples have arrived. A source that can wait has no clock of its own.
void Hearing::watchClock(Index samples)
{
    if (m_source.isPatient())
        return;
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
    if (const auto departure = m_clock.note(m_position + m_missing + samples, seconds))
        tell(ListenNotice::Kind::Drift, departure->samples, departure->words);
}

void Hearing::watchDisk()
{
    const auto time = std::chrono::steady_clock::now();
    if (m_hasWarned || time - m_diskWatched < diskInterval)
        return;
    m_diskWatched = time;
    const double left = m_recorder->secondsLeft();
    if (left > diskWarningSeconds)
        return;
    m_hasWarned = true;
    tell(ListenNotice::Kind::DiskSpace, Index(left * m_buffer.format().sampleRateHz),
         "The disk takes no more than " + formatNumber(std::round(left)) + " s of what is heard.");
}

void SourceClock::restart()
{
    m_first.reset();
    m_current.reset();
    m_worthTelling = leastSeconds;
}

std::optional<SourceClock::Departure> SourceClock::note(Index counted, double seconds)
{
    const double late = seconds - double(counted) / m_rate;
    if (!m_current)
        m_current = {seconds, late, seconds};
    if (late < m_current->leastLate) {
        m_current->leastLate = late;
        m_current->at = seconds;
    }
    if (seconds - m_current->begin < intervalSeconds)
        return {};
    const ClockInterval complete = *std::exchange(m_current, std::nullopt);
    if (m_first)
        return departureIn(complete);
    m_first = complete;
    return {};
}

std::optional<SourceClock::Departure> SourceClock::departureIn(const ClockInterval &interval)
{
    const double behind = interval.leastLate - m_first->leastLate;
    if (std::abs(behind) < m_worthTelling)
        return {};
    while (m_worthTelling <= std::abs(behind))
        m_worthTelling *= 2.0;
    const double elapsed = interval.at - m_first->at;
    Departure departure{Index(std::llround(behind * m_rate)), 1e6 * behind / elapsed, {}};
    char words[200];
    std::snprintf(
        words, sizeof words,
        "The source's clock is %.3g ppm %s: in %.4g s it has got %.3g s %s this machine's; times are the source's.",
        std::abs(departure.ppm), behind > 0.0 ? "slow" : "fast", elapsed, std::abs(behind),
        behind > 0.0 ? "behind" : "ahead of");
    departure.words = words;
    return departure;
}

} // namespace faintline
