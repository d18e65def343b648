#include "live/Player.h"

#include "base/Error.h"

#include <algorithm>
#include <cstring>

namespace faintline {

namespace {

    constexpr double aheadSeconds = 0.3;
    constexpr Index renderedSamples = 2048; ///< rendered at a time
    constexpr std::chrono::milliseconds pollInterval{5};

    StreamFormat formatFor(const SoundDevice &device)
    {
        StreamFormat format;
        format.sampleRateHz = device.sampleRateHz > 0.0 ? device.sampleRateHz : 48000.0;
        format.channelCount = std::min(2, device.outputChannels);
        return format;
    }

} // namespace

Player::Player(RecordingPointer recording, int channel, const PlaySettings &settings, const std::string &device,
               const std::string &where)
    : m_device(findSoundDevice(device, SoundDirection::Out, where)), m_format(formatFor(m_device)),
      m_sound(std::move(recording), channel, settings, m_format.sampleRateHz),
      m_rendering([this](const std::stop_token &stop) { renderAhead(stop); }),
      m_stream(
          m_device, SoundDirection::Out, m_format, [this](std::span<std::byte> block, bool) { give(block); }, where)
{
}

void Player::renderAhead(const std::stop_token &stop)
{
    std::vector<float> some(std::size_t{renderedSamples});
    const auto enough = std::size_t(aheadSeconds * m_format.sampleRateHz);
    try {
        for (Index next = 0; !stop.stop_requested(); next += renderedSamples) {
            next += leaveOut(m_sound.behindBy(next));
            while (!m_sound.isThere(next + renderedSamples) && !stop.stop_requested())
                std::this_thread::sleep_for(pollInterval);
            m_sound.render(next, some);
            std::unique_lock lock(m_mutex);
            m_changed.wait(lock, stop, [&] { return m_ready.size() < enough; });
            m_ready.insert(m_ready.end(), some.begin(), some.end());
        }
    } catch (const Error &error) {
        const std::lock_guard lock(m_mutex);
        m_failure = error.what();
    }
}

Index Player::leaveOut(Index samples)
{
    const std::lock_guard lock(m_mutex);
    m_leftOut += samples;
    return samples;
}

/// Called in the device's thread: copies the rendered samples to every channel and pads with silence.
void Player::give(std::span<std::byte> block)
{
    const auto channels = std::size_t(m_format.channelCount);
    std::fill(block.begin(), block.end(), std::byte{0});
    {
        const std::lock_guard lock(m_mutex);
        const std::size_t count = std::min(m_ready.size(), block.size() / sizeof(float) / channels);
        for (std::size_t i = 0; i < count * channels; ++i)
            std::memcpy(block.data() + i * sizeof(float), &m_ready[i / channels], sizeof(float));
        m_ready.erase(m_ready.begin(), m_ready.begin() + std::ptrdiff_t(count));
        m_givenCount += Index(count);
    }
    m_changed.notify_one();
}

Index Player::heardCount() const
{
    const auto delay = Index(m_stream.outputDelaySeconds() * m_format.sampleRateHz);
    const std::lock_guard lock(m_mutex);
    return std::max<Index>(0, m_givenCount + m_leftOut - delay);
}

double Player::positionSeconds() const
{
    return m_sound.secondsAt(heardCount());
}

bool Player::isOver() const
{
    return !m_sound.loops() && heardCount() >= m_sound.length();
}

std::optional<std::string> Player::failure() const
{
    {
        const std::lock_guard lock(m_mutex);
        if (!m_failure.empty())
            return m_failure;
    }
    return m_stream.failure();
}

} // namespace faintline
