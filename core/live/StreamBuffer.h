#pragma once

#include "base/Axis.h"
#include "live/sources/SampleSource.h"
#include "signal/Recording.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace faintline {

/// Holds received samples that are still needed, between the receiving and the analysing thread.
///
/// Positions count samples in time from the first; lost samples appear as gaps. Holds at most `capacity` bytes: a
/// source that can wait is made to, and other sources lose the rest.
class StreamBuffer
{
public:
    StreamBuffer(const StreamFormat &format, std::size_t capacity);

    // Called by the receiving thread:

    /// Whether `bytes` bytes fit now or within `patience`.
    bool hasRoom(std::size_t bytes, std::chrono::milliseconds patience);
    /// Appends whole samples of all channels.
    void push(std::vector<std::byte> bytes);
    /// Appends a gap of `samples` samples.
    void pushGap(Index samples);
    /// Marks the end of the stream.
    void end();
    /// Raises the capacity to at least `capacity` bytes.
    void widen(std::size_t capacity);

    // Called by the analysing thread:

    /// Waits until all samples before this position have arrived or are known to be lost; false if they never will.
    bool waitFor(Index position, const std::stop_token &stop = {}) const;
    /// Length in time so far, gaps included, and whether it is final.
    Index length() const;
    bool isEnded() const;
    /// Arrival time of the sample before a position or, in a gap, of those around it. The sample must not have been
    /// released.
    std::chrono::steady_clock::time_point heardAt(Index position) const;
    /// Releases the samples before a position.
    void release(Index position);
    /// One channel's samples as floats; 0 in gaps.
    void read(int channel, Index first, Index count, std::span<float> out) const;
    /// Whether no sample in this range lies in a gap.
    bool isWhole(Index first, Index count) const;

    const StreamFormat &format() const { return m_format; }

private:
    struct Delivery {
        Index first;
        Index count;
        std::vector<std::byte> bytes;
        std::chrono::steady_clock::time_point heardAt; ///< of its last sample
    };

    StreamFormat m_format;
    std::size_t m_capacity;
    mutable std::mutex m_mutex;
    mutable std::condition_variable_any m_changed;
    std::deque<Delivery> m_deliveries; ///< ascending; discontinuities are gaps
    std::size_t m_heldBytes = 0;
    Index m_length = 0;
    bool m_isEnded = false;
};

/// A buffer's stream as a recording; released samples read as 0.
///
/// Its length is `endlessSamples` unless the stream ended before construction. Floats are assumed to lie within 2^±30.
class StreamRecording final : public Recording
{
public:
    StreamRecording(std::shared_ptr<const StreamBuffer> buffer, std::optional<double> startUnixSeconds);

    void read(int channel, Index first, Index count, std::span<float> out) const override;
    bool isWhole(Index first, Index count) const override { return m_buffer->isWhole(first, count); }
    bool isFinite(int channel, Index first, Index count) const override
    {
        return m_buffer->format().type.number != SampleType::Number::Float
               || nonFiniteCountIn(channel, first, count) == 0;
    }

private:
    std::shared_ptr<const StreamBuffer> m_buffer;
};

} // namespace faintline
