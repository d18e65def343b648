#include "live/StreamBuffer.h"

#include "live/streamInfo.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr Index pieceSamples = 1 << 15; ///< stored together

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
        const bool goesOn = !m_pieces.empty() && m_pieces.back().first + m_pieces.back().count == m_length
                            && m_pieces.back().count + count <= pieceSamples;
        if (goesOn) { // many small pieces would cost more than they hold
            Delivery &last = m_pieces.back();
            last.bytes.insert(last.bytes.end(), bytes.begin(), bytes.end());
            last.count += count;
            last.heardAt = now;
        } else {
            m_pieces.push_back({m_length, count, std::move(bytes), now});
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
    const auto piece = std::partition_point(m_pieces.begin(), m_pieces.end(),
                                            [=](const Delivery &each) { return each.first + each.count < position; });
    if (piece == m_pieces.end())
        return std::chrono::steady_clock::now();
    // The samples of a piece arrived at the sample rate.
    const double later = double(std::max<Index>(0, piece->first + piece->count - position)) / m_format.sampleRateHz;
    return piece->heardAt
           - std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(later));
}

void StreamBuffer::release(Index position)
{
    {
        const std::lock_guard lock(m_mutex);
        while (!m_pieces.empty() && m_pieces.front().first + m_pieces.front().count <= position) {
            m_heldBytes -= m_pieces.front().bytes.size();
            m_pieces.pop_front();
        }
    }
    m_changed.notify_all();
}

void StreamBuffer::read(int channel, Index first, Index count, std::span<float> out) const
{
    const Index floats = m_format.type.isComplex ? 2 : 1;
    std::fill_n(out.begin(), count * floats, 0.0f);
    const std::lock_guard lock(m_mutex);
    auto piece = std::partition_point(m_pieces.begin(), m_pieces.end(),
                                      [first](const Delivery &each) { return each.first + each.count <= first; });
    for (; piece != m_pieces.end() && piece->first < first + count; ++piece) {
        const Index from = std::max(first, piece->first);
        const Index run = std::min(first + count, piece->first + piece->count) - from;
        const Index offset = (from - piece->first) * m_format.frameBytes() + channel * m_format.type.sampleBytes();
        convertSamples(m_format.type, std::span<const std::byte>(piece->bytes).subspan(std::size_t(offset)),
                       m_format.frameBytes(),
                       out.subspan(std::size_t((from - first) * floats), std::size_t(run * floats)));
    }
}

bool StreamBuffer::isWhole(Index first, Index count) const
{
    const std::lock_guard lock(m_mutex);
    auto piece = std::partition_point(m_pieces.begin(), m_pieces.end(),
                                      [first](const Delivery &each) { return each.first + each.count <= first; });
    Index known = first;
    for (; piece != m_pieces.end() && piece->first <= known && known < first + count; ++piece)
        known = piece->first + piece->count;
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
