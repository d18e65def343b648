#pragma once

#include "live/sources/SampleSource.h"
#include "live/sources/SoundStream.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// Passes samples from a device's thread to the reading thread. The device's thread never blocks; samples that do not
/// fit are dropped and counted at their position.
class SoundIntake
{
public:
    /// `frameBytes`: size of one sample of all channels.
    SoundIntake(Index frameBytes, std::size_t capacity);

    /// Called by the device's thread: appends samples, preceded by `lostBefore` that the device itself dropped.
    void put(std::span<const std::byte> block, Index lostBefore = 0);

    /// Samples up to the next loss, with the loss before them; waits at most `patience` and may return none.
    Heard take(std::chrono::milliseconds patience);

private:
    Index m_frameBytes;
    std::size_t m_capacity;
    std::mutex m_mutex;
    std::condition_variable m_came;
    std::vector<std::byte> m_filled;
    std::vector<std::byte> m_taken;
    Index m_lostBefore = 0; ///< lost before the samples in m_filled
    Index m_lostAfter = 0;  ///< lost after them, so far
};

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
