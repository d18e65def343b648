#pragma once

#include "live/sources/SoundIntake.h"
#include "live/sources/SoundStream.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

namespace faintline {

/// Requested settings of a sound device.
struct SoundSettings {
    std::string device = "default"; ///< name, or part of one (findSoundDevice)
    SampleType type;                ///< 32 or 16 bits; float holds the full range of any card
    double sampleRateHz = 0.0;      ///< 0: the device's own
    int channelCount = 0;           ///< 0: the device's, at most two
};

/// A sound card, or a device of a sound server.
///
/// Samples not read in time are lost and counted exactly; the length of a loss in the device itself is measured by the
/// clock. If the device disappears, the source tries to reopen it by name every second.
class SoundSource final : public SampleSource
{
public:
    /// Throws Error if there is no such device.
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
    std::unique_ptr<SoundStream> m_stream;   ///< null without a device; declared after the members its thread uses
    std::optional<Clock::time_point> m_last; ///< arrival of the last samples
    Clock::time_point m_asked{};
    bool m_isGone = false;
};

} // namespace faintline
