#pragma once

#include "analyse/EndedTracks.h"

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace faintline {

/// A change in the state of an event.
struct EventChange {
    enum class State {
        Provisional, ///< the statistic has exceeded the threshold
        Confirmed,   ///< track confirmed by track.confirmNats and track.confirmFrames
        Updated,     ///< in progress, or ended but may still be continued
        Final        ///< no longer changes
    };

    State state = State::Provisional;
    Event event;               ///< as known so far; for a track in progress, where it last had evidence
    std::optional<int> partOf; ///< final: continues as the event with this number
    bool isWithdrawn = false;  ///< final: another track follows the same signal, or its surroundings explain it
};

/// Follows a chain's tracks from frame to frame and reports each change under the number assigned at detection.
///
/// Each number is reported first as provisional and last as final. A track that has ended gets its second pass (ends,
/// bands, SNR and kind, EndedTracks) and becomes final when no current or future track can continue it (joinTracks) and
/// the frames behind its end are there, or is withdrawn if nothing is left of it. The final events equal those of a run
/// over a file with the same samples. Memory holds the tracks in progress, those that may still be continued, the frames
/// that their second pass needs, and the final events.
class EventFollower
{
public:
    using Sink = std::function<void(const EventChange &)>;

    /// Reports a track in progress every `updateFrames` frames. `plan` and `chain` must outlive this object.
    EventFollower(const AnalysisPlan &plan, DetectionChain &chain, Index updateFrames, Sink sink);

    /// Call after the chain has been updated with this frame.
    void take(Index frame, std::span<const float> y);
    /// Call after the chain has finished.
    void finish();

    /// All final events, by onset, then frequency; the same as `events` returns for a run over the same samples.
    std::vector<Event> finalEvents() const;

private:
    struct Open {
        bool isConfirmed = false;
        Index toldFrame = 0;
        Index detectFrame = 0;
        Index onsetFrame = 0;
        Index earliestEnd = 0;
        std::size_t keptPoints = 0; ///< of its path, by m_secondPass
        Event heard{};              ///< as it was there
    };

    void followTrackers(Index frame);
    void takeEnded();
    void joinWhatCan();
    void closeWhatCan(Index firstOnset, Index lastEnd);
    void keepBehindEnds(Index frame);
    Index firstNeeded(Index frame) const;
    bool isBlocked(const Track &track) const;
    bool mayGoOn(const Track &track, Index firstOnset) const;
    Event eventOf(const Track &track) const;
    Event eventSoFar(const Track &track);
    Event eventNow(const HmmTracker &tracker, Index frame) const;
    void tell(EventChange::State state, Event event) const;

    const AnalysisPlan &m_plan;
    DetectionChain &m_chain;
    JoinRule m_rule;
    Index m_updateFrames;
    Sink m_sink;
    EndedTracks m_secondPass;
    std::map<int, Open> m_open;   ///< tracks in progress, by number
    std::map<int, Track> m_ended; ///< may continue one that has not ended yet
    std::vector<Track> m_joined;  ///< may still be continued
    std::vector<Event> m_final;
    int m_lastId = 0;
};

} // namespace faintline
