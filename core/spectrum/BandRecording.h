#pragma once

#include "recording/Recording.h"
#include "spectrum/BlockFilter.h"

#include <vector>

namespace faintline {

/// One band of a recording's channel, as I/Q at the same sample rate: of real samples the analytic signal, so that its real
/// part is the band of the recording. By BlockFilter, whose edges are some of its cells (rate/8192) wide. Thread-safe.
class BandRecording final : public Recording
{
public:
    /// A sample is made from so many behind it, at most.
    static constexpr Index reachSamples = 8192;

    /// What of the band lies outside the recording's is left out; of a band upside down nothing is left.
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
