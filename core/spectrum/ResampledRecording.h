#pragma once

#include "recording/Recording.h"
#include "spectrum/FrequencyCurve.h"

namespace faintline {

/// A recording whose time is stretched, from moment to moment, so that every multiple of a fundamental f(t) stays at
/// that multiple of one frequency f0:
///
///   s(u) = x(t(u)),   f0·u = ∫₀ᵗ f dt
///
/// u and t begin together and go apart where f is not f0, so the duration changes. Interpolated with a sinc of 96 zero
/// crossings under Kaiser's window (β = 9), cut off at 0.94 of half the rate, or where time runs faster, f < f0, of f/f0
/// of it: what lies below 0.88 of that keeps its level, and what would be folded back is 80 dB down and more.
/// Thread-safe; samples are a pure function of (recording, curve, index).
class ResampledRecording final : public Recording
{
public:
    /// `toHz`: f0. Throws Error unless it and the curve lie above 0 Hz and within a factor of 8 of each other.
    ResampledRecording(RecordingPointer base, int channel, const FrequencyCurve &curve, double toHz);

    /// u of a time t of the base, s.
    double secondsOf(double baseSeconds) const;

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int /*channel*/) const override { return m_base->scaleExponent(m_channel); }

private:
    double baseSecondsOf(double seconds) const;
    void readBlock(Index first, std::span<float> out) const;

    RecordingPointer m_base;
    int m_channel;
    FrequencyCurve m_curve;
    double m_toHz;
};

} // namespace faintline
