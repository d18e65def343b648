#pragma once

#include <string>
#include <vector>

namespace faintline {

enum class SoundDirection { In, Out };

/// A sound device of this machine, named as by its sound system.
struct SoundDevice {
    enum class System { PulseAudio, Jack, Alsa }; ///< PipeWire appears as the first two

    System system = System::PulseAudio;
    std::string name;
    int inputChannels = 0;
    int outputChannels = 0;
    double sampleRateHz = 0.0; ///< native rate; 0: unknown
    bool isDefaultInput = false;
    bool isDefaultOutput = false;

    int channels(SoundDirection direction) const
    {
        return direction == SoundDirection::In ? inputChannels : outputChannels;
    }
    bool isDefault(SoundDirection direction) const
    {
        return direction == SoundDirection::In ? isDefaultInput : isDefaultOutput;
    }
};

/// "PulseAudio", "JACK", "ALSA".
std::string soundSystemName(SoundDevice::System system);

/// The devices of PulseAudio, JACK and ALSA, in this order; empty if no sound server runs and there is no sound card.
std::vector<SoundDevice> soundDevices();

/// The device of that name, or the only one whose name contains it, ignoring case; "default": the default of the first
/// sound system that has one. Throws Error{where, available devices}.
SoundDevice findSoundDevice(const std::string &name, SoundDirection direction, const std::string &where);

/// The same, among the given devices.
SoundDevice findSoundDevice(const std::vector<SoundDevice> &devices, const std::string &name, SoundDirection direction,
                            const std::string &where);

} // namespace faintline
