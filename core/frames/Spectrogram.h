#pragma once

#include "base/Field.h"
#include "base/Grid.h"
#include "base/RunContext.h"
#include "frames/Window.h"
#include "signal/Fft.h"
#include "signal/Recording.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// How a recording is divided into spectra, in Billon's terms.
struct SpectrogramSettings {
    double windowSeconds = 0.0; ///< T_FT; 0 chooses it from the recording
    int stepsPerWindow = 2;     ///< k_t: frames per T_FT
    int binsPerCell = 2;        ///< k_f: bins per resolution cell 1/T_FT
    WindowShape window = WindowShape::Hann;

    /// Of a window of so many samples: the fast length from binsPerCell times that on.
    int transformLength(int windowSamples) const { return Fft::fastLength(windowSamples * binsPerCell); }

    static const std::vector<Field<SpectrogramSettings>> &fields();
    bool operator==(const SpectrogramSettings &) const = default;
};

/// The part of a recording to analyse.
struct SelectionSettings {
    int channel = 0;                ///< the only channel, or the first of `channels`
    std::vector<double> channels{}; ///< channels whose evidence is added; -1 alone: all; empty: `channel` only
    double fromSeconds = 0.0;
    double toSeconds = 0.0; ///< 0: to the end
    double lowHz = 0.0;     ///< band, relative to the centre frequency for I/Q
    double highHz = 0.0;    ///< low = high: the whole band

    static const std::vector<Field<SelectionSettings>> &fields();
    bool operator==(const SelectionSettings &) const = default;
};

/// Whether the band has no limits.
bool isWholeBand(const SelectionSettings &selection);

/// Checks conditions across fields. Throws Error naming the field.
void checkChannels(const SelectionSettings &selection);

/// Throws Error naming the field that chose the channel if `what` has only `count` channels.
void checkChannel(const SelectionSettings &selection, const std::string &what, int count);

/// The channels analysed together, starting with `channel`. Throws Error if the recording lacks one of them.
std::vector<int> channelsOf(const SelectionSettings &selection, const RecordingInfo &info);

/// The sliding spectrum of a recording, computed on demand:
///
///   y(t, f) = |Σₙ w(n) x(t·hop + n) e^{-2πi f n}|²,   Σ w² = 1
///
/// `hop` = T_FT/k_t samples, transform length ≥ k_f·T_FT samples (rounded up to a fast length). White noise of variance
/// σ² gives E[y] = σ², in units of 4^scaleExponent(), which is 1 unless samples lie beyond 2^±30, whose squares exceed
/// the range of float. The time of a frame is the middle of its window. Real input gives the bins from 0 Hz to half the
/// sample rate, complex input those from -½ to +½ of it, relative to the recording's centre frequency. Source: Billon
/// 2005, sections 4 and 5. Oracle: a direct discrete Fourier transform. Thread-safe; frames are a pure function of
/// (recording, settings, index).
class Spectrogram
{
public:
    /// Throws Error if the recording is shorter than a window or the settings leave no bin.
    Spectrogram(RecordingPointer recording, const SpectrogramSettings &settings,
                const SelectionSettings &selection = {});

    const Axis &time() const { return m_time; }
    const Axis &frequency() const { return m_frequency; }
    const Recording &recording() const { return *m_recording; }
    RecordingPointer recordingPointer() const { return m_recording; }
    const SpectrogramSettings &settings() const { return m_settings; }
    const SelectionSettings &selection() const { return m_selection; }

    /// Binary exponent removed from the samples before they are squared (Recording::scaleExponent).
    int scaleExponent() const { return m_scaleExponent; }

    Index firstSample() const { return m_firstSample; } ///< index in the recording of the first frame's first sample
    int windowSamples() const { return m_windowSamples; }
    double windowSeconds() const; ///< actual T_FT, a whole number of samples
    int hopSamples() const { return m_hopSamples; }
    int transformLength() const { return m_fft->length(); }
    /// Actual number of bins per resolution cell: transform length over window length.
    double binsPerCell() const { return double(m_fft->length()) / m_windowSamples; }

    /// Whether the band ends at 0 Hz and half the rate of real samples. There the spectrum overlaps its mirror image, y
    /// follows another law (χ² of one degree of freedom), and at 0 Hz there is often a constant.
    bool hasRealEnds() const;

    /// Whether all samples in a frame's window were observed (Recording::isObserved). Otherwise the frame was not
    /// observed: its power is 0 throughout, as in digital silence, so it does not affect the noise estimate, and its
    /// normalised value is NaN.
    bool isObserved(Index frame) const
    {
        return m_recording->isObserved(m_selection.channel, m_firstSample + frame * m_hopSamples, m_windowSamples);
    }

    /// Computes frames first … first+count-1 into `out`, count × frequency().count values, row by row, on as many
    /// threads as the context allows.
    void read(Index first, Index count, std::span<float> out, const RunContext &context = {}) const;

    /// Frame and bin spacing of a recording with these settings.
    struct Steps {
        double seconds = 0.0;
        double hz = 0.0;
    };
    static Steps stepsOf(const SpectrogramSettings &settings, const RecordingInfo &info);

    /// Default T_FT for a recording: 3·√(duration/rate), rounded to 1, 2 or 5 · 10ⁿ seconds, which
    /// gives about as many cells as frames; at most a quarter of the recording, and of its stretches without a gap
    /// (Stretches::typicalCount).
    static double automaticWindowSeconds(const RecordingInfo &info);

private:
    /// Samples first … end-1 of the recording.
    struct SelectedSamples {
        Index first;
        Index end;
        Index count() const { return end - first; }
    };
    SelectedSamples selectedSamples() const;
    void chooseWindow(Index sampleCount);
    void selectBand();

    void readRun(Index first, Index count, std::vector<float> &samples, Fft::Buffer &buffer,
                 std::span<float> out) const;
    void transformFrame(std::span<const float> samples, Fft::Buffer &buffer, std::span<float> out) const;

    RecordingPointer m_recording;
    SpectrogramSettings m_settings;
    SelectionSettings m_selection;
    int m_windowSamples = 0;
    int m_hopSamples = 0;
    int m_scaleExponent = 0;
    Index m_firstSample = 0;
    Index m_firstBin = 0; ///< of the band, in ascending frequency
    std::vector<float> m_window;
    std::shared_ptr<const Fft> m_fft;
    Axis m_time;
    Axis m_frequency;
};

/// Number of channels whose evidence is added. Throws Error if it depends on the recording.
int channelCount(const SelectionSettings &selection);

} // namespace faintline
