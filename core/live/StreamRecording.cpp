#include "live/StreamRecording.h"

#include "live/streamInfo.h"

namespace faintline {

StreamRecording::StreamRecording(std::shared_ptr<const StreamBuffer> buffer, std::optional<double> startUnixSeconds)
    : m_buffer(std::move(buffer))
{
    m_info = streamInfo(m_buffer->format());
    if (m_buffer->isEnded())
        m_info.sampleCount = m_buffer->length();
    m_info.startUnixSeconds = startUnixSeconds;
}

void StreamRecording::read(int channel, Index first, Index count, std::span<float> out) const
{
    fill(first, count, out, [&](Index from, std::span<float> inside) {
        m_buffer->read(channel, from, std::ssize(inside) / m_info.floatsPerSample(), inside);
    });
}

} // namespace faintline
