#pragma once

#include "analyse/LiveFrames.h"
#include "analyse/events.h"

#include <memory>
#include <optional>
#include <vector>

namespace faintline {

/// Gives each track of a run that goes on its second pass when it has ended, as a file's tracks over a causal background
/// get it (secondLook.h), from frames that are kept for as long as a track needs them (LiveFrames).
///
/// No track has one if the settings exclude it, or in frames so large that those kept whole exceed 128 MiB.
class EndedTracks
{
public:
    /// `openFrames`: number of newest frames in which tracks may still begin, be joined, or change. `plan` must outlive
    /// this.
    EndedTracks(const AnalysisPlan &plan, Index openFrames);

    /// Frames before and after a track that are read with it.
    static Index framesBeside();

    /// Takes the frame after the last one; the first one may have any number.
    void take(Index frame, std::span<const float> y, double lnK);
    /// Keeps the cells around a place of a track's path.
    void keep(Index frame, Index cell);
    /// Keeps the strip of a track from a frame on, as far as its frames have been taken.
    void keep(const Track &track, Index from = 0);
    /// No track needs the frames before this one, and those beside them.
    void forgetBefore(Index frame);

    /// What remains of an ended track as an event; nothing if its surroundings explain it. Without a second pass, the
    /// event of the chain's track: also if its beginning is no longer kept.
    std::optional<Event> eventOf(const Track &track);
    /// Sets what depends on the number of frames taken.
    void complete(Event &event) const;

private:
    AnalysisPlan planSoFar() const;

    const AnalysisPlan &m_plan;
    std::shared_ptr<LiveFrames> m_frames; ///< null: there is no second pass
    std::vector<float> m_lnK;             ///< of its frames, and some before
    Index m_firstLnK = 0;
};

} // namespace faintline
