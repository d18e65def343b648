#pragma once

#include "live/PlayedSound.h"
#include "live/SoundStream.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace faintline {

/// Plays a stretch of a recording on a sound device, from its making to its end. Of a recording that is being made, it waits
/// in silence for what is not there yet, and is that much later from then on; where it is two seconds behind, because the
/// device's clock is slower than the source's, it leaves some out.
class Player
{
public:
    /// `device`: as findSoundDevice takes it. Throws Error{where, …} where there is none.
    Player(RecordingPointer recording, int channel, const PlaySettings &settings, const std::string &device,
           const std::string &where);

    /// The recording's time that is heard now.
    double positionSeconds() const;
    /// Whether all of it has been heard.
    bool isOver() const;
    /// Why nothing is heard any more: the device is gone, or the recording cannot be read.
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
    std::deque<float> m_ready; ///< that the device has not taken yet
    Index m_givenCount = 0;    ///< samples that it has
    Index m_leftOut = 0;       ///< samples, because the recording had run away
    std::string m_failure;
    std::jthread m_rendering;
    SoundStream m_stream; ///< last: its thread uses what is above
};

} // namespace faintline
