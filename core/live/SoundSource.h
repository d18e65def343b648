#pragma once

#include "live/SoundIntake.h"
#include "live/SoundStream.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace faintline {

/// What a sound device is asked for.
struct SoundSettings {
    std::string device = "default"; ///< name, or part of one (findSoundDevice)
    SampleType type;                ///< of 32 or 16 bits; floats hold all that any card gives
    double sampleRateHz = 0.0;      ///< 0: the device's own
    int channelCount = 0;           ///< 0: the device's, at most two
};

/// A sound card, or what a sound server has in its place.
///
/// What is not heard in time is lost, to the sample; what the device itself drops is as long as the clock says. A device
/// that goes away is asked for again every second, by its name.
class SoundSource final : public SampleSource
{
public:
    /// Throws Error where there is no such device.
    explicit SoundSource(const SoundSettings &settings);

    const StreamFormat &format() const override { return m_format; }
    Heard hear(std::chrono::milliseconds patience) override;

private:
    using Clock = std::chrono::steady_clock;

    void open();
    bool openAgain();
    Heard lose(const std::string &why);

    SoundDevice m_device;
    StreamFormat m_format;
    SoundIntake m_intake;
    std::unique_ptr<SoundStream> m_stream;   ///< null while there is no device; after what its thread uses
    std::optional<Clock::time_point> m_last; ///< when samples came
    Clock::time_point m_asked{};
    bool m_isGone = false;
};

} // namespace faintline
