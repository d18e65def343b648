#pragma once

#include "frames/NormalisedFrames.h"

#include <future>
#include <vector>

namespace faintline {

/// Reads frames in order, in blocks of about 1 MiB, or of up to 16 frames if they take at most 16 MiB, one block ahead on
/// another thread if there is a spare one.
class FrameStream
{
public:
    FrameStream(const NormalisedFrames &frames, bool readsAhead); ///< `frames` must outlive this
    /// Of the frames from `first` up to, not including, `end`.
    FrameStream(const NormalisedFrames &frames, bool readsAhead, Index first, Index end);

    /// Index of the first frame of `next`.
    Index position() const { return m_position; }

    /// The next block, row by row; empty at the end.
    std::vector<float> next();

private:
    std::vector<float> read(Index first) const;
    void prefetch();

    const NormalisedFrames &m_frames;
    bool m_readsAhead;
    Index m_blockFrames;
    Index m_position;
    Index m_end;
    std::future<std::vector<float>> m_block;
};

} // namespace faintline
