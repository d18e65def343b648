#pragma once

#include <string>
#include <vector>

namespace faintline {

enum class SoundDirection { In, Out };

/// A sound device of this machine, under the name that its sound system has for it.
struct SoundDevice {
    enum class System { PulseAudio, Jack, Alsa }; ///< PipeWire answers as the first two

    System system = System::PulseAudio;
    std::string name;
    int inputChannels = 0;
    int outputChannels = 0;
    double sampleRateHz = 0.0; ///< its own; 0 where it says none
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

/// Those of PulseAudio, JACK and ALSA, in this order; none where no sound server runs and no sound card is there.
std::vector<SoundDevice> soundDevices();

/// The device of that name, or the only one whose name contains it, in capitals or not; "default": the default of the
/// first sound system that has one. Throws Error{where, which there are}.
SoundDevice findSoundDevice(const std::string &name, SoundDirection direction, const std::string &where);

/// The same among given ones.
SoundDevice findSoundDevice(const std::vector<SoundDevice> &devices, const std::string &name, SoundDirection direction,
                            const std::string &where);

} // namespace faintline
