#pragma once

#include "analysis/events.h"
#include "track/DetectionChain.h"

#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace faintline {

/// What has become of an event.
struct EventChange {
    enum class State {
        Provisional, ///< the statistic has exceeded the threshold
        Confirmed,   ///< its track is, by track.confirmNats and track.confirmFrames
        Updated,     ///< it goes on, or has ended and may still be continued
        Final        ///< nothing of it changes any more
    };

    State state = State::Provisional;
    Event event;               ///< as far as it is known; of a track in progress, position and statistic of now
    std::optional<int> partOf; ///< final: it goes on as that event
    bool isWithdrawn = false;  ///< final: another track turned out to follow the same signal
};

/// Follows a chain's tracks from frame to frame and tells what becomes of each, under the number it was detected with.
///
/// Every number is told of as provisional first and as final last. A track becomes final when it has ended and no track
/// in progress or to come can continue it (joinTracks): what is final are the events of a run over a file with the same
/// samples. Memory: the tracks in progress and those that may still be continued, and the final events.
class EventFollower
{
public:
    using Sink = std::function<void(const EventChange &)>;

    /// Tells of a track in progress every `updateFrames` frames. `plan` and `chain` outlive this.
    EventFollower(const AnalysisPlan &plan, DetectionChain &chain, Index updateFrames, Sink sink);

    /// After the chain's update with this frame.
    void take(Index frame);
    /// After the chain's end.
    void finish();

    /// All that are final, by onset, then frequency: what `events` gives of a run over the same samples.
    std::vector<Event> finalEvents() const;

private:
    struct Open {
        bool isConfirmed = false;
        Index toldFrame = 0;
        Index detectFrame = 0;
        Index onsetFrame = 0;
        Index earliestEnd = 0;
    };

    void followTrackers(Index frame);
    void takeEnded();
    void joinWhatCan();
    void closeWhatCan(Index firstOnset);
    bool isBlocked(const Track &track) const;
    bool mayGoOn(const Track &track, Index firstOnset) const;
    Event eventOf(const Track &track) const;
    Event eventNow(const HmmTracker &tracker, Index frame) const;
    void tell(EventChange::State state, Event event) const;

    const AnalysisPlan &m_plan;
    DetectionChain &m_chain;
    JoinRule m_rule;
    Index m_updateFrames;
    Sink m_sink;
    std::map<int, Open> m_open;   ///< tracks in progress, by number
    std::map<int, Track> m_ended; ///< that may continue one that has not ended yet
    std::vector<Track> m_joined;  ///< that may be continued
    std::vector<Event> m_final;
    int m_lastId = 0;
};

} // namespace faintline
