#pragma once

#include "recording/Recording.h"
#include "spectrum/Fft.h"
#include "spectrum/FrequencyCurve.h"

#include <memory>
#include <vector>

namespace faintline {

/// A recording shifted in frequency, from moment to moment, so that what runs along a curve f(t) stays at one frequency:
///
///   s(t) = Re{ a(t)·e^(-2πi ∫ (f - f0) dt) },   a = x + i·H{x}
///
/// H: Hilbert transform, of blocks under a √Hann window, half a block apart, that is laid on before and after it; of I/Q
/// samples a = x, and s is complex. The phase is a continuous function of the curve alone. The whole band moves with the
/// line, so noise stays what it was; what comes within |f - f0| of 0 Hz or half the rate is folded there. Thread-safe;
/// samples are a pure function of (recording, curve, index).
class StraightenedRecording final : public Recording
{
public:
    /// `toHz`: f0. Throws Error unless it lies in the recording's band.
    StraightenedRecording(RecordingPointer base, int channel, const FrequencyCurve &curve, double toHz);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int /*channel*/) const override { return m_base->scaleExponent(m_channel); }

private:
    void turn(Index first, std::span<float> samples) const;
    void addBlock(Index block, Index first, std::span<float> out) const;

    RecordingPointer m_base;
    int m_channel;
    FrequencyCurve m_curve;
    double m_toHz;
    std::shared_ptr<const Fft> m_fft;
    std::vector<float> m_window; ///< √Hann
};

} // namespace faintline
