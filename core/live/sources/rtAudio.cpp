#include "live/sources/rtAudio.h"

#include "live/sources/soundDevices.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include <pulse/pulseaudio.h>

namespace faintline {

namespace {

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

} // namespace

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

namespace {

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

std::vector<SoundDevice> soundDevices()
{
    const std::lock_guard lock(rtAudioMutex());
    std::vector<SoundDevice> devices;
    for (const NamedSystem &each : soundSystems)
        addDevices(each, devices);
    return devices;
}

} // namespace faintline
