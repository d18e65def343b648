#include "signal/ArrayRecording.h"

#include "base/Error.h"
#include "base/Field.h"

#include <algorithm>

namespace faintline {

ArrayRecording::ArrayRecording(const std::string &where, std::shared_ptr<const float> samples,
                               const ArrayLayout &layout)
    : m_samples(std::move(samples))
{
    constexpr double highestRate = 1e12;
    if (!(layout.sampleRateHz > 0.0 && layout.sampleRateHz <= highestRate))
        throw Error(where + ": rate = " + formatNumber(layout.sampleRateHz), "must be a sample rate above 0 Hz");
    if (layout.sampleCount < 1 || layout.channelCount < 1)
        throw Error(where, "holds no samples");
    m_info.path = where;
    m_info.container = "array";
    m_info.sampleType = layout.isComplex ? "complex64" : "float32";
    m_info.sampleRateHz = layout.sampleRateHz;
    m_info.sampleCount = layout.sampleCount;
    m_info.channelCount = layout.channelCount;
    m_info.isComplex = layout.isComplex;
    m_info.centreHz = layout.centreHz;
}

void ArrayRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        const Index floats = m_info.floatsPerSample();
        const Index stride = floats * m_info.channelCount;
        const float *sample = m_samples.get() + from * stride + channel * floats;
        for (auto to = inside.begin(); to != inside.end(); sample += stride)
            to = std::copy_n(sample, floats, to);
    });
}

} // namespace faintline
