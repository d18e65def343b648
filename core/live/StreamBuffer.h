#pragma once

#include "base/Axis.h"
#include "live/SampleSource.h"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

namespace faintline {

/// What was heard and is still needed, between the thread that hears and the one that analyses.
///
/// Positions are samples in time from the first one on: what was lost keeps its place, as a gap. At most `capacity`
/// bytes are held; a source that waits is made to, of another the rest is lost.
class StreamBuffer
{
public:
    StreamBuffer(const StreamFormat &format, std::size_t capacity);

    // Of the thread that hears:

    /// Whether so many bytes go in now, or within `patience`.
    bool hasRoom(std::size_t bytes, std::chrono::milliseconds patience);
    /// Whole samples of all channels, which come next in time.
    void push(std::vector<std::byte> bytes);
    /// So many samples that were not heard come next.
    void pushGap(Index samples);
    /// Nothing comes any more.
    void end();
    /// Holds at least so much from now on.
    void widen(std::size_t capacity);

    // Of the thread that analyses:

    /// Waits until all samples before this position are there or known to be lost; false where they will not be.
    bool waitFor(Index position, const std::stop_token &stop = {}) const;
    /// The samples in time so far, and whether that is all.
    Index length() const;
    bool isEnded() const;
    /// When the sample before a position came, or those around the gap that it lies in; of one that is held or yet to
    /// come.
    std::chrono::steady_clock::time_point heardAt(Index position) const;
    /// Samples before a position will not be asked for any more.
    void release(Index position);
    /// One channel's samples as floats; 0 in gaps.
    void read(int channel, Index first, Index count, std::span<float> out) const;
    /// Whether none of these samples lies in a gap.
    bool isWhole(Index first, Index count) const;

    const StreamFormat &format() const { return m_format; }

private:
    struct Piece {
        Index first;
        Index count;
        std::vector<std::byte> bytes;
        std::chrono::steady_clock::time_point heardAt; ///< of its last sample
    };

    StreamFormat m_format;
    std::size_t m_capacity;
    mutable std::mutex m_mutex;
    mutable std::condition_variable_any m_changed;
    std::deque<Piece> m_pieces; ///< ascending; between two of them lies a gap
    std::size_t m_heldBytes = 0;
    Index m_length = 0;
    bool m_isEnded = false;
};

} // namespace faintline
