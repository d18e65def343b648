#pragma once

#include "scene/LineScene.h"
#include "scene/Truth.h"
#include "signal/Recording.h"

#include <cstdint>

namespace faintline {

/// Amplitude A of a tone whose SNR in one resolution cell of a rectangular window of T samples is r.
///
/// The window's discrete Fourier transform at the tone's frequency, |Σ x|² :
///   complex: noise of variance σ² gives σ²T, the tone A·e^(iφ) gives A²T²      →  r = A²T/σ²,     A = σ√(r/T)
///   real:    noise of variance σ² gives σ²T, the tone A·cos φ gives A²T²/4     →  r = A²T/(4σ²),  A = 2σ√(r/T)
/// For coloured noise σ² is the variance of white noise with the same density at the tone's frequency.
double toneAmplitude(double snrDb, double noiseVariance, double windowSamples, bool isComplex);

/// A spectral line as a function of the sample index, with a continuous phase:
///
///   complex: A·g(t)·e^(iφ(t)),   real: A·Re(g(t)·e^(iφ(t))),   φ' = 2π(f(t) - centreHz),   t = index / rate
///
/// f and the factor g of fading or fluctuation are those of LineSettings, determined by (seed, number); f is linear
/// between nodes 0.1·referenceSeconds (0.1·wanderSeconds, if shorter) apart, so φ is a parabola there, in closed form.
/// A stretch gives the same values however it is divided. Thread-safe.
class Tone
{
public:
    /// `recording` gives the sample rate, real or I/Q, centre frequency and end.
    Tone(const LineSettings &line, double amplitude, const RecordingInfo &recording, std::uint64_t seed, Index number);

    /// Adds the tone's samples from `first` on.
    void addTo(Index first, std::span<float> out) const;

    const TruthLine &truth() const { return m_truth; }

private:
    Index firstSampleOf(Index interval) const;
    Index intervalOf(Index sample) const;
    void addRun(Index interval, Index first, std::span<float> out) const;
    float dwellAmplitude(Index sample) const;

    TruthLine m_truth;
    double m_sampleRateHz;
    double m_centreHz;
    bool m_isComplex;
    Index m_begin = 0; ///< first sample of the tone
    Index m_end = 0;
    std::vector<double> m_turns; ///< phase at the nodes, in turns
    double m_fadingStepSeconds = 0.0;
    std::vector<double> m_fadingReal; ///< g at its own nodes; empty means g = 1
    std::vector<double> m_fadingImaginary;
    double m_dwellSeconds = 0.0;
    std::vector<float> m_dwellAmplitudes; ///< √power of each dwell of a fluctuating line; empty means 1
};

/// What is known of all tones of a recording.
Truth truthOf(const std::vector<Tone> &tones);

} // namespace faintline
