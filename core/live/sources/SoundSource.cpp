#include "live/sources/SoundSource.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <thread>
#include <utility>

namespace faintline {

namespace {

    using Clock = std::chrono::steady_clock;

    const std::string option = "--device";
    constexpr double intakeSeconds = 10.0;
    constexpr std::chrono::seconds deviceInterval{1};
    constexpr std::chrono::seconds silence{1};

    StreamFormat formatFor(const SoundSettings &settings, const SoundDevice &device)
    {
        StreamFormat format;
        format.type = settings.type;
        format.sampleRateHz = settings.sampleRateHz > 0.0 ? settings.sampleRateHz
                              : device.sampleRateHz > 0.0 ? device.sampleRateHz
                                                          : 48000.0;
        format.channelCount = settings.channelCount > 0 ? settings.channelCount : std::min(2, device.inputChannels);
        format.origin = soundSystemName(device.system) + ", " + device.name;
        if (format.sampleRateHz != std::floor(format.sampleRateHz) || format.sampleRateHz > 1e6)
            throw Error("--raw-rate", "of a sound device must be whole and at most 1000000 Hz");
        if (format.channelCount > device.inputChannels)
            throw Error("--raw-channels", device.name + " has " + std::to_string(device.inputChannels));
        return format;
    }

    /// Samples missing according to the clock.
    Index missedSince(Clock::time_point last, double rate, Index came)
    {
        const double elapsed = std::chrono::duration<double>(Clock::now() - last).count();
        return std::max<Index>(0, Index(std::llround(elapsed * rate)) - came);
    }

} // namespace

SoundSource::SoundSource(const SoundSettings &settings)
    : m_device(findSoundDevice(settings.device, SoundDirection::In, option + " " + settings.device)),
      m_format(formatFor(settings, m_device)),
      m_intake(m_format.frameBytes(),
               std::size_t(intakeSeconds * m_format.sampleRateHz) * std::size_t(m_format.frameBytes()))
{
    open();
}

void SoundSource::open()
{
    const auto takeIn = [this, last = Clock::now()](std::span<std::byte> block, bool isAfterLoss) mutable {
        const Index samples = std::ssize(block) / m_format.frameBytes();
        m_intake.put(block, isAfterLoss ? missedSince(last, m_format.sampleRateHz, samples) : 0);
        last = Clock::now();
    };
    m_stream = std::make_unique<SoundStream>(m_device, SoundDirection::In, m_format, takeIn, option);
}

bool SoundSource::openAgain()
{
    if (Clock::now() - m_asked < deviceInterval)
        return false;
    m_asked = Clock::now();
    try {
        open();
    } catch (const Error &) { // not back yet
    }
    return m_stream != nullptr;
}

Heard SoundSource::lose(const std::string &why)
{
    Heard heard;
    if (std::exchange(m_isGone, true))
        return heard;
    heard.incident = Heard::Incident::Gone;
    heard.words = "The sound device is " + why + ".";
    return heard;
}

Heard SoundSource::hear(std::chrono::milliseconds patience)
{
    if (!m_stream && !openAgain()) {
        std::this_thread::sleep_for(patience);
        return {};
    }
    Heard heard = m_intake.take(patience);
    if (heard.bytes.empty()) {
        if (const auto failure = m_stream->failure()) {
            m_stream.reset();
            return lose("gone: " + *failure);
        }
        return m_last && Clock::now() - *m_last > silence ? lose("silent") : Heard();
    }
    if (std::exchange(m_isGone, false) && m_last) {
        heard.lostSamples =
            missedSince(*m_last, m_format.sampleRateHz, std::ssize(heard.bytes) / m_format.frameBytes());
        heard.incident = Heard::Incident::Back;
        heard.words = "The sound device is back.";
    } else if (heard.lostSamples > 0) {
        heard.incident = Heard::Incident::Lost;
        heard.words = std::to_string(heard.lostSamples) + " samples of the sound device were lost.";
    }
    m_last = Clock::now();
    return heard;
}

SoundIntake::SoundIntake(Index frameBytes, std::size_t capacity) : m_frameBytes(frameBytes), m_capacity(capacity)
{
    m_filled.reserve(capacity);
    m_taken.reserve(capacity);
}

void SoundIntake::put(std::span<const std::byte> block, Index lostBefore)
{
    {
        const std::lock_guard lock(m_mutex);
        (m_filled.empty() ? m_lostBefore : m_lostAfter) += lostBefore;
        if (m_lostAfter > 0 || m_filled.size() + block.size() > m_capacity)
            m_lostAfter += std::ssize(block) / m_frameBytes; // one loss at a time, until these samples are taken
        else
            m_filled.insert(m_filled.end(), block.begin(), block.end());
    }
    m_came.notify_one();
}

Heard SoundIntake::take(std::chrono::milliseconds patience)
{
    Heard heard;
    {
        std::unique_lock lock(m_mutex);
        m_came.wait_for(lock, patience, [this] { return !m_filled.empty(); });
        std::swap(m_filled, m_taken);
        heard.lostSamples = std::exchange(m_lostBefore, std::exchange(m_lostAfter, 0));
    }
    heard.bytes.assign(m_taken.begin(), m_taken.end());
    m_taken.clear();
    return heard;
}

} // namespace faintline
