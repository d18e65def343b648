#include "live/StreamRecording.h"

#include "recording/endless.h"

namespace faintline {

StreamRecording::StreamRecording(std::shared_ptr<const StreamBuffer> buffer, std::optional<double> startUnixSeconds)
    : m_buffer(std::move(buffer))
{
    const StreamFormat &format = m_buffer->format();
    m_info.path = format.origin;
    m_info.container = "stream";
    m_info.sampleType = format.type.name();
    m_info.sampleRateHz = format.sampleRateHz;
    m_info.sampleCount = m_buffer->isEnded() ? m_buffer->length() : endlessSamples;
    m_info.channelCount = format.channelCount;
    m_info.isComplex = format.type.isComplex;
    m_info.centreHz = format.centreHz;
    m_info.startUnixSeconds = startUnixSeconds;
}

void StreamRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        m_buffer->read(channel, from, std::ssize(inside) / m_info.floatsPerSample(), inside);
    });
}

} // namespace faintline
