#include "live/Player.h"

#include "base/Error.h"
#include "signal/BandRecording.h"
#include "signal/StraightenedRecording.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>

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

    constexpr double crossings = 16.0; ///< zero crossings of the kernel on each side
    constexpr Index kernelSteps = 512; ///< points per crossing
    constexpr double transition = 0.95;
    constexpr double meanLevel = 0.1;
    constexpr double besideHz = 300.0;
    constexpr double levelSeconds = 10.0; ///< preceding time that sets the level of a recording in progress
    constexpr double farBehindSeconds = 2.0;
    constexpr double behindSeconds = 0.5;

    /// Right half of a Hann-windowed sinc.
    std::vector<float> halfKernel()
    {
        std::vector<float> kernel(std::size_t(crossings * double(kernelSteps)) + 2, 0.0f);
        for (std::size_t i = 0; i + 2 < kernel.size(); ++i) {
            const double u = std::numbers::pi * double(i) / double(kernelSteps);
            const double window = 0.5 + 0.5 * std::cos(u / crossings);
            kernel[i] = float(i == 0 ? 1.0 : std::sin(u) / u * window);
        }
        return kernel;
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

PlayedSound::PlayedSound(RecordingPointer recording, int channel, const PlaySettings &settings, double deviceRateHz)
    : m_recording(std::move(recording)), m_channel(channel), m_settings(settings), m_deviceRate(deviceRateHz),
      m_step(settings.speed * m_recording->info().sampleRateHz / deviceRateHz),
      m_cutoff(std::min(1.0, transition / m_step)),
      m_length(Index(std::ceil((settings.toSeconds - settings.fromSeconds) / settings.speed * deviceRateHz))),
      m_kernel(halfKernel()), m_gain(measuredGain())
{
}

double PlayedSound::reachSeconds() const
{
    return (crossings / m_cutoff + 2.0) / m_recording->info().sampleRateHz;
}

bool PlayedSound::isThere(Index sample) const
{
    return !m_settings.endSeconds || secondsAt(sample) + reachSeconds() <= m_settings.endSeconds();
}

Index PlayedSound::behindBy(Index sample) const
{
    const double behind = m_settings.endSeconds ? m_settings.endSeconds() - secondsAt(sample) : 0.0;
    return behind < farBehindSeconds ? 0 : Index((behind - behindSeconds) / m_settings.speed * m_deviceRate);
}

/// From samples spread over the interval played or, live, over the preceding seconds.
double PlayedSound::measuredGain() const
{
    constexpr Index stretches = 16;
    constexpr Index stretch = 4096;
    const RecordingInfo &info = m_recording->info();
    const bool isGrowing = bool(m_settings.endSeconds);
    const double from = isGrowing ? std::max(0.0, m_settings.fromSeconds - levelSeconds) : m_settings.fromSeconds;
    const double to = isGrowing ? m_settings.fromSeconds : m_settings.toSeconds;
    const auto first = Index(from * info.sampleRateHz);
    const auto last = Index(to * info.sampleRateHz);
    std::vector<float> samples(std::size_t(stretch * info.floatsPerSample()));
    double sum = 0.0;
    Index count = 0;
    for (Index i = 0; i < stretches; ++i) {
        const Index length = std::min(stretch, last - first);
        m_recording->read(m_channel, first + (last - first - length) * i / stretches, length, samples);
        for (const float value : std::span(samples).first(std::size_t(length * info.floatsPerSample()))) {
            sum += double(value) * double(value);
            count += value != 0.0f;
        }
    }
    return sum > 0.0 ? meanLevel / std::sqrt(sum / double(count)) : 0.0;
}

float PlayedSound::kernel(double distance) const
{
    const double at = std::min(std::abs(distance), crossings) * double(kernelSteps);
    const auto below = std::size_t(at);
    const auto rest = float(at - double(below));
    return m_kernel[below] + rest * (m_kernel[below + 1] - m_kernel[below]);
}

double PlayedSound::secondsAt(Index sample) const
{
    if (!m_settings.loops && sample >= m_length)
        return m_settings.toSeconds;
    return m_settings.fromSeconds + double(sample % m_length) * m_settings.speed / m_deviceRate;
}

void PlayedSound::render(Index first, std::span<float> out) const
{
    while (!out.empty()) {
        const Index inPass = m_settings.loops ? first % m_length : first;
        const Index count = std::min(std::ssize(out), m_length - inPass);
        if (count <= 0)
            return std::fill(out.begin(), out.end(), 0.0f);
        renderPass(inPass, first, out.first(std::size_t(count)));
        out = out.subspan(std::size_t(count));
        first += count;
    }
}

/// Samples of one pass from `first` on; `number`: index of the first one over all passes, for the tone's phase.
void PlayedSound::renderPass(Index first, Index number, std::span<float> out) const
{
    const RecordingInfo &info = m_recording->info();
    const double reach = crossings / m_cutoff;
    const double begin = m_settings.fromSeconds * info.sampleRateHz + double(first) * m_step;
    const auto from = Index(std::floor(begin - reach));
    const Index count = Index(std::ceil(double(out.size()) * m_step + 2.0 * reach)) + 2;
    const Index floats = info.floatsPerSample();
    std::vector<float> samples(std::size_t(count * floats));
    m_recording->read(m_channel, from, count, samples);
    for (std::size_t i = 0; i < out.size(); ++i) {
        const double position = begin + double(i) * m_step - double(from);
        std::complex<double> sum = 0.0;
        const auto last = std::min(count - 1, Index(std::floor(position + reach)));
        for (auto k = Index(std::ceil(position - reach)); k <= last; ++k) {
            const auto weight = double(kernel(m_cutoff * (position - double(k))));
            const float *const value = samples.data() + k * floats;
            sum += weight * std::complex<double>(double(value[0]), floats == 2 ? double(value[1]) : 0.0);
        }
        const double cycles = m_settings.toneHz * double(number + Index(i)) / m_deviceRate;
        sum *= std::polar(m_gain * m_cutoff, 2.0 * std::numbers::pi * (cycles - std::floor(cycles)));
        out[i] = float(std::clamp(sum.real(), -1.0, 1.0));
    }
}

RecordingPointer lineToPlay(const RecordingPointer &recording, int channel, const FrequencyCurve &line)
{
    const auto [least, most] = std::minmax_element(line.hz().begin(), line.hz().end());
    const auto band = std::make_shared<BandRecording>(recording, channel, *least - besideHz, *most + besideHz);
    return std::make_shared<StraightenedRecording>(band, 0, line, 0.0);
}

} // namespace faintline
