#pragma once

#include "live/SampleSource.h"
#include "live/soundDevices.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace faintline {

/// A sound device that runs, by RtAudio: takes or gives blocks of a fiftieth of a second from its beginning to its end.
class SoundStream
{
public:
    /// Called for each block in a thread of the sound system, which does not wait: the block's samples came in, or are to
    /// be filled in. `isAfterLoss`: the device dropped some before these.
    using Exchange = std::function<void(std::span<std::byte> block, bool isAfterLoss)>;

    /// `format`: signed integers of 16 or 32 bits or floats of 32, of this machine's byte order. Throws Error.
    SoundStream(const SoundDevice &device, SoundDirection direction, const StreamFormat &format, Exchange exchange,
                const std::string &where);
    /// No exchange is called after it.
    ~SoundStream();
    SoundStream(const SoundStream &) = delete;
    SoundStream &operator=(const SoundStream &) = delete;

    /// Why the device gives or takes nothing any more; none while it does.
    std::optional<std::string> failure() const;
    /// Time from a sample's exchange to its sound, at most, s; of an output.
    double outputDelaySeconds() const;

private:
    struct Running;
    std::shared_ptr<Running> m_running;
};

} // namespace faintline
