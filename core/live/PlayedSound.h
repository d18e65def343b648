#pragma once

#include "recording/Recording.h"
#include "spectrum/FrequencyCurve.h"

#include <functional>
#include <span>
#include <vector>

namespace faintline {

/// How a stretch of a recording is played.
struct PlaySettings {
    double fromSeconds = 0.0;
    double toSeconds = 0.0;
    double speed = 1.0; ///< of time, and so of all frequencies but toneHz
    bool loops = false;
    double toneHz = 0.0; ///< where 0 Hz of I/Q samples is heard, at any speed
    /// Of a recording that is being made: up to where it can be played by now, s; any thread asks. Empty: all of it.
    std::function<double()> endSeconds{};
};

/// The samples a sound device gets for a stretch of a recording: resampled (32 crossings of a windowed sinc, band-limited to
/// what both rates hold), the real part of I/Q, at -20 dB of full scale in the mean and cut off at full scale.
/// Thread-safe; samples are a pure function of their number.
class PlayedSound
{
public:
    /// Precondition: fromSeconds < toSeconds, speed > 0.
    PlayedSound(RecordingPointer recording, int channel, const PlaySettings &settings, double deviceRateHz);

    double deviceRateHz() const { return m_deviceRate; }
    bool loops() const { return m_settings.loops; }
    /// Samples of one pass.
    Index length() const { return m_length; }
    /// Samples from number `first` ≥ 0 on; 0 after the end of the only pass.
    void render(Index first, std::span<float> out) const;
    /// Whether the recording has grown far enough for the samples before this one.
    bool isThere(Index sample) const;
    /// How many samples have to be left out from this one on, where the recording has run away from what is played.
    Index behindBy(Index sample) const;
    /// The recording's time that a sample comes from; of one after the end the end.
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
    double m_step;   ///< recording's samples a device's sample
    double m_cutoff; ///< of the recording's half rate
    Index m_length;
    std::vector<float> m_kernel;
    double m_gain;
};

/// A line with 300 Hz to either side, as I/Q in which it stays at 0 Hz: to be played with toneHz.
RecordingPointer lineToPlay(const RecordingPointer &recording, int channel, const FrequencyCurve &line);

} // namespace faintline
