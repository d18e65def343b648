// Stands in for SoundStream.cpp where RtAudio or PulseAudio is not installed: there are no sound devices.

#include "base/Error.h"
#include "live/sources/SoundStream.h"

namespace faintline {

std::vector<SoundDevice> soundDevices()
{
    return {};
}

SoundStream::SoundStream(const SoundDevice &, SoundDirection, const StreamFormat &, Exchange, const std::string &where)
{
    throw Error(where, "this build of Faintline has no sound; it needs librtaudio and libpulse");
}

struct SoundStream::Running {};

SoundStream::~SoundStream() = default;
std::optional<std::string> SoundStream::failure() const
{
    return {};
}
double SoundStream::outputDelaySeconds() const
{
    return 0.0;
}

} // namespace faintline
