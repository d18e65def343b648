#pragma once

#include "recording/Recording.h"

#include <memory>

namespace faintline {

/// What samples in memory are.
struct ArrayLayout {
    double sampleRateHz = 0.0;
    Index sampleCount = 0; ///< per channel
    int channelCount = 1;
    bool isComplex = false; ///< a sample is two floats, I and Q
    double centreHz = 0.0;  ///< frequency that 0 Hz of the samples stands for
};

/// Samples that are in memory already, sample after sample, its channels side by side.
///
/// They are not copied: `samples` keeps what owns them alive, and they must not change meanwhile. They are in a unit of
/// their own, as those of a file of floats are. Thread-safe.
class ArrayRecording final : public Recording
{
public:
    /// `samples`: sampleCount × channelCount × (isComplex ? 2 : 1) floats. Throws Error naming `where` for a rate that
    /// is no positive number and for no samples.
    ArrayRecording(const std::string &where, std::shared_ptr<const float> samples, const ArrayLayout &layout);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    int scaleExponent(int channel) const override { return measuredScaleExponent(channel); }

private:
    std::shared_ptr<const float> m_samples;
};

} // namespace faintline
