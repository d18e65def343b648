#pragma once

#include "signal/Recording.h"

#include <memory>

namespace faintline {

/// Layout of samples in memory.
struct ArrayLayout {
    double sampleRateHz = 0.0;
    Index sampleCount = 0; ///< per channel
    int channelCount = 1;
    bool isComplex = false; ///< a sample is two floats, I and Q
    double centreHz = 0.0;  ///< frequency that corresponds to 0 Hz of the samples
};

/// Samples that are already in memory, with interleaved channels.
///
/// The samples are not copied: `samples` shares their ownership, and they must not change. Like those of a float file,
/// they are in their own unit. Thread-safe.
class ArrayRecording final : public Recording
{
public:
    /// `samples`: sampleCount × channelCount × (isComplex ? 2 : 1) floats. Throws Error naming `where` if the rate is
    /// not a positive number or there are no samples.
    ArrayRecording(const std::string &where, std::shared_ptr<const float> samples, const ArrayLayout &layout);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int channel) const override { return measuredScaleExponent(channel); }

private:
    std::shared_ptr<const float> m_samples;
};

} // namespace faintline
