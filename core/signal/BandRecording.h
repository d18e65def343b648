#pragma once

#include "signal/BlockFilter.h"
#include "signal/Recording.h"

#include <vector>

namespace faintline {

/// One band of a recording's channel, as I/Q at the same sample rate. For real samples it is the analytic signal, whose
/// real part is the recording's band. Filtered by BlockFilter; the edges are a few of its cells (rate/8192) wide.
/// Thread-safe.
class BandRecording final : public Recording
{
public:
    /// Largest number of samples that a sample of the band depends on.
    static constexpr Index reachSamples = 8192;

    /// The band is clipped to the recording's; with lowHz > highHz nothing passes.
    BandRecording(RecordingPointer base, int channel, double lowHz, double highHz);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int /*channel*/) const override { return m_base->scaleExponent(m_channel); }

private:
    void addBlock(Index block, Index first, std::span<float> out) const;

    RecordingPointer m_base;
    int m_channel;
    BlockFilter m_filter;
    std::vector<float> m_gains;
};

} // namespace faintline
