#include "live/soundDevices.h"

#include "base/Error.h"
#include "live/rtAudio.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

namespace faintline {

namespace {

    struct NamedSystem {
        SoundDevice::System system;
        RtAudio::Api api;
        const char *name;
    };

    constexpr std::array<NamedSystem, 3> systems{{{SoundDevice::System::PulseAudio, RtAudio::LINUX_PULSE, "PulseAudio"},
                                                  {SoundDevice::System::Jack, RtAudio::UNIX_JACK, "JACK"},
                                                  {SoundDevice::System::Alsa, RtAudio::LINUX_ALSA, "ALSA"}}};

    void addDevices(const NamedSystem &asked, std::vector<SoundDevice> &devices)
    {
        if (!mayAskRtAudio(asked.api))
            return;
        try {
            RtAudio audio(asked.api);
            audio.showWarnings(false);
            const unsigned count = audio.getDeviceCount();
            for (unsigned i = 0; i < count; ++i) {
                const RtAudio::DeviceInfo info = audio.getDeviceInfo(i);
                if (info.probed && !info.name.empty())
                    devices.push_back({asked.system, info.name, int(info.inputChannels), int(info.outputChannels),
                                       double(info.preferredSampleRate), info.isDefaultInput, info.isDefaultOutput});
            }
        } catch (const RtAudioError &) { // a system that does not answer has none
        }
    }

    std::string inLowerCase(std::string text)
    {
        std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
        return text;
    }

    std::string namesOf(const std::vector<SoundDevice> &devices)
    {
        std::string names;
        for (const SoundDevice &device : devices)
            names += (names.empty() ? "" : ", ") + device.name;
        return names;
    }

} // namespace

std::string soundSystemName(SoundDevice::System system)
{
    return std::find_if(systems.begin(), systems.end(), [&](const NamedSystem &each) { return each.system == system; })
        ->name;
}

std::vector<SoundDevice> soundDevices()
{
    const std::lock_guard lock(rtAudioMutex());
    std::vector<SoundDevice> devices;
    for (const NamedSystem &each : systems)
        addDevices(each, devices);
    return devices;
}

SoundDevice findSoundDevice(const std::string &name, SoundDirection direction, const std::string &where)
{
    return findSoundDevice(soundDevices(), name, direction, where);
}

SoundDevice findSoundDevice(const std::vector<SoundDevice> &devices, const std::string &name, SoundDirection direction,
                            const std::string &where)
{
    std::vector<SoundDevice> able;
    std::copy_if(devices.begin(), devices.end(), std::back_inserter(able),
                 [direction](const SoundDevice &each) { return each.channels(direction) > 0; });
    if (able.empty())
        throw Error(where,
                    std::string("this machine has no sound ") + (direction == SoundDirection::In ? "input" : "output")
                        + ": no sound server with a device answers, and there is no sound card",
                    Error::Kind::Failure);
    const auto find = [&](const auto &fits) { return std::find_if(able.begin(), able.end(), fits); };
    if (name == "default") {
        const auto found = find([direction](const SoundDevice &each) { return each.isDefault(direction); });
        return found != able.end() ? *found : able.front();
    }
    if (const auto same = find([&](const SoundDevice &each) { return each.name == name; }); same != able.end())
        return *same;
    const auto contains = [part = inLowerCase(name)](const SoundDevice &each) {
        return inLowerCase(each.name).find(part) != std::string::npos;
    };
    const auto fitting = std::count_if(able.begin(), able.end(), contains);
    if (fitting == 1)
        return *find(contains);
    throw Error(where, (fitting == 0 ? "there is no such sound device; " : "fits more than one sound device; ")
                           + ("there are: " + namesOf(able)));
}

} // namespace faintline
