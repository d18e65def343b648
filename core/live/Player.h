#pragma once

#include "live/PlayedSound.h"
#include "live/sources/SoundStream.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace faintline {

/// Plays an interval of a recording on a sound device, from construction to destruction. If the recording is still in
/// progress, plays silence until the next samples exist, which delays the rest by as much. If playback lags by two
/// seconds because the device's clock is slower than the source's, skips samples.
class Player
{
public:
    /// `device`: as in findSoundDevice. Throws Error{where, …} if no device matches.
    Player(RecordingPointer recording, int channel, const PlaySettings &settings, const std::string &device,
           const std::string &where);

    /// Time in the recording that is being heard.
    double positionSeconds() const;
    /// Whether playback has finished.
    bool isOver() const;
    /// Why playback stopped: the device is gone, or the recording cannot be read.
    std::optional<std::string> failure() const;

private:
    void renderAhead(const std::stop_token &stop);
    Index leaveOut(Index samples);
    void give(std::span<std::byte> block);
    Index heardCount() const;

    SoundDevice m_device;
    StreamFormat m_format;
    PlayedSound m_sound;
    mutable std::mutex m_mutex;
    std::condition_variable_any m_changed;
    std::deque<float> m_ready; ///< rendered, not yet taken by the device
    Index m_givenCount = 0;    ///< samples taken by the device
    Index m_leftOut = 0;       ///< samples skipped to catch up with the recording
    std::string m_failure;
    std::jthread m_rendering;
    SoundStream m_stream; ///< last: its thread uses the members above
};

} // namespace faintline
