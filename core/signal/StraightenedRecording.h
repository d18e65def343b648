#pragma once

#include "signal/BlockFilter.h"
#include "signal/FrequencyCurve.h"
#include "signal/Recording.h"

#include <vector>

namespace faintline {

/// A recording shifted in frequency over time, so that a line along a curve f(t) stays at one frequency:
///
///   s(t) = Re{ a(t)·e^(-2πi ∫ (f - f0) dt) },   a = x + i·H{x}
///
/// H: Hilbert transform, block by block (BlockFilter). For I/Q samples a = x, and s is complex. The phase is a
/// continuous function of the curve alone. The whole band moves with the line, so the noise is unchanged; components
/// within |f - f0| of 0 Hz or half the rate are aliased. Thread-safe; samples are a pure function of (recording, curve,
/// index).
class StraightenedRecording final : public DerivedRecording
{
public:
    /// `toHz`: f0. Throws Error if it lies outside the recording's band.
    StraightenedRecording(RecordingPointer base, int channel, const FrequencyCurve &curve, double toHz);

    const FrequencyCurve &curve() const { return m_curve; }
    double targetHz() const { return m_toHz; }

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int /*channel*/) const override { return m_base->scaleExponent(m_channel); }

private:
    void turn(Index first, std::span<float> samples) const;
    void addBlock(Index block, Index first, std::span<float> out) const;

    int m_channel;
    FrequencyCurve m_curve;
    double m_toHz;
    BlockFilter m_filter;
    std::vector<float> m_gains; ///< of the analytic signal's filter
};

/// A recording with its time axis stretched so that every multiple of a fundamental f(t) stays at that multiple of a
/// constant f0:
///
///   s(u) = x(t(u)),   f0·u = ∫₀ᵗ f dt
///
/// u and t start together and diverge where f differs from f0, so the duration changes. Interpolates with a sinc of 96
/// zero crossings under a Kaiser window (β = 9), cut off at 0.94 of half the rate, or at f/f0 of that where time runs
/// faster, f < f0. Components below 0.88 of that keep their level; aliases are at least 80 dB down. Thread-safe;
/// samples are a pure function of (recording, curve, index).
class ResampledRecording final : public Recording
{
public:
    /// `toHz`: f0. Throws Error unless it and the curve lie above 0 Hz and within a factor of 8 of each other.
    ResampledRecording(RecordingPointer base, int channel, const FrequencyCurve &curve, double toHz);

    /// u for a time t of the base recording, s.
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
