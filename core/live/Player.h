#pragma once

#include "live/sources/SoundStream.h"
#include "signal/FrequencyCurve.h"
#include "signal/Recording.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace faintline {

/// How an interval of a recording is played.
struct PlaySettings {
    double fromSeconds = 0.0;
    double toSeconds = 0.0;
    double speed = 1.0; ///< scales time, and so all frequencies except toneHz
    bool loops = false;
    double toneHz = 0.0; ///< audio frequency of 0 Hz in I/Q, at any speed
    /// For a recording in progress: the time up to which it can be played, s; called from any thread. Empty: all of it.
    std::function<double()> endSeconds{};
};

/// The samples sent to a sound device: the interval resampled (32 crossings of a windowed sinc, band-limited to the
/// lower Nyquist frequency), the real part of I/Q, at a mean level of -20 dB re full scale, clipped. Thread-safe;
/// samples are a pure function of their index.
class PlayedSound
{
public:
    /// Precondition: fromSeconds < toSeconds, speed > 0.
    PlayedSound(RecordingPointer recording, int channel, const PlaySettings &settings, double deviceRateHz);

    double deviceRateHz() const { return m_deviceRate; }
    bool loops() const { return m_settings.loops; }
    /// Samples of one pass.
    Index length() const { return m_length; }
    /// Fills `out` with samples from index `first` ≥ 0 on; 0 after the end unless looping.
    void render(Index first, std::span<float> out) const;
    /// Whether the recording is long enough to compute this sample.
    bool isThere(Index sample) const;
    /// Number of samples to skip from this one on because playback lags too far behind the recording.
    Index behindBy(Index sample) const;
    /// Time in the recording of a sample, at most the end.
    double secondsAt(Index sample) const;

private:
    void renderPass(Index first, Index number, std::span<float> out) const;
    float kernel(double distance) const;
    double measuredGain() const;
    double reachSeconds() const;

    RecordingPointer m_recording;
    int m_channel;
    PlaySettings m_settings;
    double m_deviceRate;
    double m_step;   ///< recording samples per device sample
    double m_cutoff; ///< as a fraction of the recording's Nyquist frequency
    Index m_length;
    std::vector<float> m_kernel;
    double m_gain;
};

/// The band of ±300 Hz around a line, as I/Q with the line at 0 Hz, for playback with toneHz.
RecordingPointer lineToPlay(const RecordingPointer &recording, int channel, const FrequencyCurve &line);

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
