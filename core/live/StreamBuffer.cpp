#include "live/StreamBuffer.h"

#include "live/streamInfo.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index deliverySamples = 1 << 15; ///< stored together

} // namespace

StreamBuffer::StreamBuffer(const StreamFormat &format, std::size_t capacity) : m_format(format), m_capacity(capacity) {}

bool StreamBuffer::hasRoom(std::size_t bytes, std::chrono::milliseconds patience)
{
    std::unique_lock lock(m_mutex);
    return m_changed.wait_for(lock, patience, [&] { return m_heldBytes + bytes <= m_capacity; });
}

void StreamBuffer::push(std::vector<std::byte> bytes)
{
    const Index count = std::ssize(bytes) / m_format.frameBytes();
    if (count == 0)
        return;
    const auto now = std::chrono::steady_clock::now();
    {
        const std::lock_guard lock(m_mutex);
        m_heldBytes += bytes.size();
        const bool goesOn = !m_deliveries.empty() && m_deliveries.back().first + m_deliveries.back().count == m_length
                            && m_deliveries.back().count + count <= deliverySamples;
        if (goesOn) { // many small ones would cost more than they hold
            Delivery &last = m_deliveries.back();
            last.bytes.insert(last.bytes.end(), bytes.begin(), bytes.end());
            last.count += count;
            last.heardAt = now;
        } else {
            m_deliveries.push_back({m_length, count, std::move(bytes), now});
        }
        m_length += count;
    }
    m_changed.notify_all();
}

void StreamBuffer::pushGap(Index samples)
{
    {
        const std::lock_guard lock(m_mutex);
        m_length += samples;
    }
    m_changed.notify_all();
}

void StreamBuffer::end()
{
    {
        const std::lock_guard lock(m_mutex);
        m_isEnded = true;
    }
    m_changed.notify_all();
}

void StreamBuffer::widen(std::size_t capacity)
{
    {
        const std::lock_guard lock(m_mutex);
        m_capacity = std::max(m_capacity, capacity);
    }
    m_changed.notify_all();
}

bool StreamBuffer::waitFor(Index position, const std::stop_token &stop) const
{
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, stop, [&] { return m_length >= position || m_isEnded; });
    return m_length >= position;
}

Index StreamBuffer::length() const
{
    const std::lock_guard lock(m_mutex);
    return m_length;
}

bool StreamBuffer::isEnded() const
{
    const std::lock_guard lock(m_mutex);
    return m_isEnded;
}

std::chrono::steady_clock::time_point StreamBuffer::heardAt(Index position) const
{
    const std::lock_guard lock(m_mutex);
    const auto delivery = std::partition_point(m_deliveries.begin(), m_deliveries.end(), [=](const Delivery &each) {
        return each.first + each.count < position;
    });
    if (delivery == m_deliveries.end())
        return std::chrono::steady_clock::now();
    // The samples of a delivery arrived at the sample rate.
    const double later =
        double(std::max<Index>(0, delivery->first + delivery->count - position)) / m_format.sampleRateHz;
    return delivery->heardAt
           - std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(later));
}

void StreamBuffer::release(Index position)
{
    {
        const std::lock_guard lock(m_mutex);
        while (!m_deliveries.empty() && m_deliveries.front().first + m_deliveries.front().count <= position) {
            m_heldBytes -= m_deliveries.front().bytes.size();
            m_deliveries.pop_front();
        }
    }
    m_changed.notify_all();
}

void StreamBuffer::read(int channel, Index first, Index count, std::span<float> out) const
{
    const Index floats = m_format.type.isComplex ? 2 : 1;
    std::fill_n(out.begin(), count * floats, 0.0f);
    const std::lock_guard lock(m_mutex);
    auto delivery = std::partition_point(m_deliveries.begin(), m_deliveries.end(),
                                         [first](const Delivery &each) { return each.first + each.count <= first; });
    for (; delivery != m_deliveries.end() && delivery->first < first + count; ++delivery) {
        const Index from = std::max(first, delivery->first);
        const Index run = std::min(first + count, delivery->first + delivery->count) - from;
        const Index offset = (from - delivery->first) * m_format.frameBytes() + channel * m_format.type.sampleBytes();
        convertSamples(m_format.type, std::span<const std::byte>(delivery->bytes).subspan(std::size_t(offset)),
                       m_format.frameBytes(),
                       out.subspan(std::size_t((from - first) * floats), std::size_t(run * floats)));
    }
}

bool StreamBuffer::isWhole(Index first, Index count) const
{
    const std::lock_guard lock(m_mutex);
    auto delivery = std::partition_point(m_deliveries.begin(), m_deliveries.end(),
                                         [first](const Delivery &each) { return each.first + each.count <= first; });
    Index known = first;
    for (; delivery != m_deliveries.end() && delivery->first <= known && known < first + count; ++delivery)
        known = delivery->first + delivery->count;
    return known >= first + count;
}

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
