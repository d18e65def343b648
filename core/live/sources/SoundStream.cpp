#include "live/sources/SoundStream.h"

#include "base/Error.h"
#include "live/sources/soundDevices.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <filesystem>
#include <memory>
#include <mutex>
#include <pulse/pulseaudio.h>
#include <rtaudio/RtAudio.h>
#include <thread>
#include <utility>

namespace faintline {

/// Hold while RtAudio lists or opens devices: its list of PulseAudio devices is shared by all threads.
std::mutex &rtAudioMutex();

/// Whether RtAudio can safely list the devices of a sound system. It keeps stale devices after a PulseAudio server
/// exits, dereferences a null pointer if the server has no default device, and lets ALSA write to standard error if
/// there is no card.
bool mayAskRtAudio(RtAudio::Api api);

namespace {

    using StreamClock = std::chrono::steady_clock;

    constexpr double blocksPerSecond = 50.0;
    constexpr unsigned outputBlocks = 5; ///< queued at the device
    constexpr int mostFailures = 8;      ///< consecutive, until the device is considered gone
    constexpr std::chrono::milliseconds stillness{500};

    RtAudio::Api apiOf(SoundDevice::System system)
    {
        switch (system) {
        case SoundDevice::System::Jack:
            return RtAudio::UNIX_JACK;
        case SoundDevice::System::Alsa:
            return RtAudio::LINUX_ALSA;
        case SoundDevice::System::PulseAudio:
            break;
        }
        return RtAudio::LINUX_PULSE;
    }

    RtAudioFormat formatOf(const SampleType &type, const std::string &where)
    {
        const std::string name = type.name();
        if (name == "ri16_le")
            return RTAUDIO_SINT16;
        if (name == "ri32_le")
            return RTAUDIO_SINT32;
        if (name == "rf32_le")
            return RTAUDIO_FLOAT32;
        throw Error(where, name + " is not a sample type of sound devices; expected ri16_le, ri32_le or rf32_le");
    }

    /// Removes the function name from "RtApiPulse::callbackEvent: audio read error, Connection terminated..".
    std::string withoutPlace(std::string words)
    {
        if (words.starts_with("RtApi"))
            words.erase(0, std::min(words.size(), words.find(": ") + 2));
        words.erase(words.find_last_not_of(".\n ") + 1);
        return words;
    }

    /// The device's current number; numbers change as devices come and go.
    unsigned indexOf(RtAudio &audio, const SoundDevice &device, SoundDirection direction, const std::string &where)
    {
        const unsigned count = mayAskRtAudio(apiOf(device.system)) ? audio.getDeviceCount() : 0;
        for (unsigned i = 0; i < count; ++i) {
            const RtAudio::DeviceInfo info = audio.getDeviceInfo(i);
            if (info.name == device.name
                && (direction == SoundDirection::In ? info.inputChannels : info.outputChannels) > 0)
                return i;
        }
        throw Error(where, "the sound device " + device.name + " was not found", Error::Kind::Failure);
    }

    /// RtAudio reports a failure in the thread where it occurs, but not for which stream.
    thread_local void *streamOfThread = nullptr;

    bool hasCard()
    {
        std::error_code none;
        const std::filesystem::directory_iterator entries("/dev/snd", none);
        return std::any_of(begin(entries), end(entries), [](const std::filesystem::directory_entry &entry) {
            return entry.path().filename().string().starts_with("controlC");
        });
    }

    /// Whether a PulseAudio server reports its default devices.
    bool hasPulseDefaults()
    {
        const std::unique_ptr<pa_mainloop, decltype(&pa_mainloop_free)> loop(pa_mainloop_new(), &pa_mainloop_free);
        const std::unique_ptr<pa_context, decltype(&pa_context_unref)> context(
            pa_context_new(pa_mainloop_get_api(loop.get()), "Faintline"), &pa_context_unref);
        if (pa_context_connect(context.get(), nullptr, PA_CONTEXT_NOAUTOSPAWN, nullptr) < 0)
            return false;
        const auto goOn = [&] { return pa_mainloop_iterate(loop.get(), 1, nullptr) >= 0; };
        const auto state = [&] { return pa_context_get_state(context.get()); };
        while (PA_CONTEXT_IS_GOOD(state()) && state() != PA_CONTEXT_READY && goOn()) {
        }
        if (state() != PA_CONTEXT_READY)
            return false;
        bool hasBoth = false;
        const auto look = [](pa_context *, const pa_server_info *info, void *found) {
            *static_cast<bool *>(found) = info && info->default_sink_name && info->default_source_name;
        };
        pa_operation *asking = pa_context_get_server_info(context.get(), look, &hasBoth);
        while (pa_operation_get_state(asking) == PA_OPERATION_RUNNING && goOn()) {
        }
        pa_operation_unref(asking);
        pa_context_disconnect(context.get());
        return hasBoth;
    }

    using NamedSystem = std::pair<SoundDevice::System, RtAudio::Api>;
    constexpr std::array<NamedSystem, 3> soundSystems{{{SoundDevice::System::PulseAudio, RtAudio::LINUX_PULSE},
                                                       {SoundDevice::System::Jack, RtAudio::UNIX_JACK},
                                                       {SoundDevice::System::Alsa, RtAudio::LINUX_ALSA}}};

    void addDevices(const NamedSystem &asked, std::vector<SoundDevice> &devices)
    {
        if (!mayAskRtAudio(asked.second))
            return;
        try {
            RtAudio audio(asked.second);
            audio.showWarnings(false);
            const unsigned count = audio.getDeviceCount();
            for (unsigned i = 0; i < count; ++i) {
                const RtAudio::DeviceInfo info = audio.getDeviceInfo(i);
                if (info.probed && !info.name.empty())
                    devices.push_back({asked.first, info.name, int(info.inputChannels), int(info.outputChannels),
                                       double(info.preferredSampleRate), info.isDefaultInput, info.isDefaultOutput});
            }
        } catch (const RtAudioError &) { // a system that does not answer has none
        }
    }

} // namespace

/// State used by the device's thread; outlives the stream if the device hangs.
struct SoundStream::Running {
    Running(RtAudio::Api api, Exchange given) : audio(api), exchange(std::move(given)) {}

    static int call(void *out, void *in, unsigned samples, double time, RtAudioStreamStatus status, void *user);
    static void noteFailure(RtAudioError::Type type, const std::string &words);
    bool isSound();

    RtAudio audio;
    std::mutex mutex; ///< guards the members below
    Exchange exchange;
    std::string failure;
    int failuresInARow = 0;
    bool hasFailed = false; ///< since the last call
    bool isFirst = true;
    bool isAfterLoss = false;
    StreamClock::time_point lastCall = StreamClock::now();

    std::size_t frameBytes = 0;
    unsigned blockSamples = 0;
};

void SoundStream::Running::noteFailure(RtAudioError::Type /*type*/, const std::string &words)
{
    if (!streamOfThread)
        return;
    auto &running = *static_cast<Running *>(streamOfThread);
    const std::lock_guard lock(running.mutex);
    running.hasFailed = true;
    running.failure = withoutPlace(words);
}

/// Whether the device has worked without error since the last call.
bool SoundStream::Running::isSound()
{
    failuresInARow = std::exchange(hasFailed, false) ? failuresInARow + 1 : 0;
    return failuresInARow == 0;
}

int SoundStream::Running::call(void *out, void *in, unsigned samples, double /*time*/, RtAudioStreamStatus status,
                               void *user)
{
    auto &running = *static_cast<Running *>(user);
    streamOfThread = user;
    const std::lock_guard lock(running.mutex);
    running.lastCall = StreamClock::now();
    const std::span block(static_cast<std::byte *>(out ? out : in), samples * running.frameBytes);
    running.isAfterLoss = running.isAfterLoss || status != 0;
    const bool isSound = running.isSound();
    if (running.failuresInARow >= mostFailures || !running.exchange)
        return 2;
    // RtAudio calls back before reading: the first input block is unfilled, and one after a failure repeats the last.
    if (in && (std::exchange(running.isFirst, false) || !isSound)) {
        running.isAfterLoss = running.isAfterLoss || !isSound;
        return 0;
    }
    running.exchange(block, std::exchange(running.isAfterLoss, false));
    return 0;
}

SoundStream::SoundStream(const SoundDevice &device, SoundDirection direction, const StreamFormat &format,
                         Exchange exchange, const std::string &where)
{
    const RtAudioFormat samples = formatOf(format.type, where);
    m_running = std::make_shared<Running>(apiOf(device.system), std::move(exchange));
    Running &running = *m_running;
    running.audio.showWarnings(false);
    running.frameBytes = std::size_t(format.frameBytes());
    running.blockSamples = unsigned(std::max(16.0, format.sampleRateHz / blocksPerSecond));
    const std::lock_guard lock(rtAudioMutex());
    RtAudio::StreamParameters parameters;
    parameters.deviceId = indexOf(running.audio, device, direction, where);
    parameters.nChannels = unsigned(format.channelCount);
    RtAudio::StreamOptions options;
    options.numberOfBuffers = outputBlocks;
    options.streamName = "Faintline";
    const bool isIn = direction == SoundDirection::In;
    try {
        running.audio.openStream(isIn ? nullptr : &parameters, isIn ? &parameters : nullptr, samples,
                                 unsigned(format.sampleRateHz), &running.blockSamples, &Running::call, &running,
                                 &options, &Running::noteFailure);
        running.audio.startStream();
    } catch (const RtAudioError &error) {
        throw Error(where, "the sound device " + device.name + " cannot be opened: " + withoutPlace(error.what()),
                    Error::Kind::Failure);
    }
}

SoundStream::~SoundStream()
{
    StreamClock::time_point lastCall;
    {
        const std::lock_guard lock(m_running->mutex);
        m_running->exchange = {};
        lastCall = m_running->lastCall;
    }
    const auto close = [running = std::move(m_running)] {
        if (running->audio.isStreamOpen())
            running->audio.closeStream();
    };
    // Closing waits for the device, forever if it hangs.
    if (StreamClock::now() - lastCall > stillness)
        std::thread(close).detach();
    else
        close();
}

std::optional<std::string> SoundStream::failure() const
{
    const std::lock_guard lock(m_running->mutex);
    if (m_running->failuresInARow < mostFailures)
        return {};
    return m_running->failure;
}

double SoundStream::outputDelaySeconds() const
{
    return outputBlocks / blocksPerSecond;
}

std::mutex &rtAudioMutex()
{
    static std::mutex mutex;
    return mutex;
}

bool mayAskRtAudio(RtAudio::Api api)
{
    switch (api) {
    case RtAudio::LINUX_PULSE:
        return hasPulseDefaults();
    case RtAudio::LINUX_ALSA:
        return hasCard();
    default:
        return true;
    }
}

std::vector<SoundDevice> soundDevices()
{
    const std::lock_guard lock(rtAudioMutex());
    std::vector<SoundDevice> devices;
    for (const NamedSystem &each : soundSystems)
        addDevices(each, devices);
    return devices;
}

} // namespace faintline
