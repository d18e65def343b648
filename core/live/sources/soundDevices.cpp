#include "live/sources/soundDevices.h"

#include "base/Error.h"
#include "base/oneLine.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace faintline {

namespace {

    std::string inLowerCase(std::string text)
    {
        std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return char(std::tolower(c)); });
        return text;
    }

} // namespace

std::string soundSystemName(SoundDevice::System system)
{
    switch (system) {
    case SoundDevice::System::PulseAudio:
        return "PulseAudio";
    case SoundDevice::System::Jack:
        return "JACK";
    case SoundDevice::System::Alsa:
        break;
    }
    return "ALSA";
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
                           + ("there are: " + listed(able, &SoundDevice::name)));
}

} // namespace faintline
