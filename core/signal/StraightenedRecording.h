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
class StraightenedRecording final : public Recording
{
public:
    /// `toHz`: f0. Throws Error if it lies outside the recording's band.
    StraightenedRecording(RecordingPointer base, int channel, const FrequencyCurve &curve, double toHz);

    const FrequencyCurve &curve() const { return m_curve; }
    double targetHz() const { return m_toHz; }

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_base->isWhole(first, count); }
    bool isFinite(int channel, Index first, Index count) const override
    {
        return m_base->isFinite(channel, first, count);
    }
    int scaleExponent(int /*channel*/) const override { return m_base->scaleExponent(m_channel); }

private:
    void turn(Index first, std::span<float> samples) const;
    void addBlock(Index block, Index first, std::span<float> out) const;

    RecordingPointer m_base;
    int m_channel;
    FrequencyCurve m_curve;
    double m_toHz;
    BlockFilter m_filter;
    std::vector<float> m_gains; ///< of the analytic signal's filter
};

} // namespace faintline
