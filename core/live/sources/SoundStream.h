#pragma once

#include "live/sources/SampleSource.h"
#include "live/sources/soundDevices.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

namespace faintline {

/// A running sound device (RtAudio). Exchanges blocks of 20 ms from construction to destruction.
class SoundStream
{
public:
    /// Called for each block in a thread of the sound system and must not wait. `block` is the input samples, or output
    /// samples to fill in. `isAfterLoss`: the device dropped samples before this block.
    using Exchange = std::function<void(std::span<std::byte> block, bool isAfterLoss)>;

    /// `format`: 16- or 32-bit signed integers or 32-bit floats, in native byte order. Throws Error.
    SoundStream(const SoundDevice &device, SoundDirection direction, const StreamFormat &format, Exchange exchange,
                const std::string &where);
    /// Does not call the exchange afterwards.
    ~SoundStream();
    SoundStream(const SoundStream &) = delete;
    SoundStream &operator=(const SoundStream &) = delete;

    /// Why the device stopped; empty while it is running.
    std::optional<std::string> failure() const;
    /// Maximum delay from a sample's exchange to its playback, s; output only.
    double outputDelaySeconds() const;

private:
    struct Running;
    std::shared_ptr<Running> m_running;
};

} // namespace faintline
