#pragma once

#include "frames/NormalisedFrames.h"

#include <deque>
#include <vector>

namespace faintline {

/// The frames of a live run that may still be asked for: the newest ones whole, older ones around the paths of tracks.
///
/// Cells that are not kept read as NaN, as if they had not been observed. Memory: the newest frames, and 32 MiB, beyond
/// which the oldest frames go.
class LiveFrames final : public NormalisedFrames
{
public:
    /// `of`: the run's frames. `wholeFrames`: number of frames kept whole. `halfWidth`: cells kept on either side of a
    /// path.
    LiveFrames(NormalisedFramesPointer of, Index wholeFrames, Index halfWidth);

    /// Takes the frame after the last one; the first one may have any number.
    void append(Index frame, std::span<const float> y);
    /// Marks a place of a track's path; without effect in a frame that is no longer whole.
    void mark(Index frame, Index cell);

    /// Frames before this one are needed no longer; those that are still whole stay.
    void forgetBefore(Index frame);
    Index firstKept() const { return m_first; }
    void read(Index first, Index count, std::span<float> out) const override;
    const Spectrogram *spectrogram() const override { return m_of->spectrogram(); }
    bool isObserved(Index frame) const override;

private:
    struct KeptCells {
        Index first;
        std::vector<float> y;
    };
    struct KeptFrame {
        std::vector<KeptCells> kept;
        std::vector<Index> marks;
        bool isObserved;
    };

    void dropFirst();
    static void thinOut(KeptFrame &frame, Index halfWidth);
    static std::size_t bytesOf(const KeptFrame &frame);

    NormalisedFramesPointer m_of;
    Index m_wholeFrames;
    Index m_halfWidth;
    Index m_first = 0;
    std::deque<KeptFrame> m_frames;
    std::size_t m_thinnedBytes = 0;
};

} // namespace faintline
