#include "live/EventFollower.h"

#include <algorithm>
#include <limits>

namespace faintline {

EventFollower::EventFollower(const AnalysisPlan &plan, DetectionChain &chain, Index updateFrames, Sink sink)
    : m_plan(plan), m_chain(chain), m_rule(chain.joinRule()), m_updateFrames(std::max<Index>(1, updateFrames)),
      m_sink(std::move(sink)),
      m_secondPass(plan, std::max(chain.longestRunUp(), chain.longestOpenPath()) + m_rule.largestGapFrames)
{
}

void EventFollower::tell(EventChange::State state, Event event) const
{
    m_sink({state, std::move(event), {}, false});
}

Event EventFollower::eventOf(const Track &track) const
{
    return events(m_plan, {track}).front();
}

Event EventFollower::eventNow(const HmmTracker &tracker, Index frame) const
{
    const Track &track = tracker.track();
    const Axis &time = m_plan.time();
    Event event;
    event.id = track.id;
    event.onsetSeconds = time.value(double(track.onsetFrame));
    event.detectSeconds = time.value(double(track.detectFrame));
    event.endSeconds = time.value(double(frame));
    const std::vector<Axis> &axes = m_plan.grid().axes;
    const std::vector<Index> &at = tracker.coordinates();
    for (std::size_t axis = 0; axis < at.size(); ++axis)
        event.position.push_back(axes[axis].value(double(at[axis])));
    event.position.back() = axes.back().value(double(at.back()) + tracker.displacement());
    event.detectedPosition = event.position;
    event.ratesPerSecond.assign(at.size(), 0.0);
    event.isOpen = true;
    return event;
}

void EventFollower::take(Index frame, std::span<const float> y)
{
    m_secondPass.take(frame, y, m_chain.detector().regulation().lnK);
    takeEnded();
    followTrackers(frame);
    keepBehindEnds(frame);
    joinWhatCan();
    closeWhatCan(frame + 2 - m_chain.longestRunUp(), frame - EndedTracks::framesBeside());
    m_secondPass.forgetBefore(firstNeeded(frame));
}

/// Keeps the places where ended tracks would have gone on.
void EventFollower::keepBehindEnds(Index frame)
{
    const auto keep = [&](const Track &track) {
        if (frame <= track.points.back().frame + EndedTracks::framesBeside())
            m_secondPass.keep(track, frame);
    };
    for (const auto &[id, track] : m_ended)
        keep(track);
    std::ranges::for_each(m_joined, keep);
}

/// The first frame of a track that is not final; the next frame if there is none.
Index EventFollower::firstNeeded(Index frame) const
{
    Index first = frame + 1;
    for (const auto &[id, open] : m_open)
        first = std::min(first, open.onsetFrame);
    for (const auto &[id, track] : m_ended)
        first = std::min(first, track.onsetFrame);
    for (const Track &track : m_joined)
        first = std::min(first, track.onsetFrame);
    return first;
}

/// Of a track that has ended but may still be continued.
Event EventFollower::eventSoFar(const Track &track)
{
    return m_secondPass.eventOf(track).value_or(eventOf(track));
}

void EventFollower::followTrackers(Index frame)
{
    using State = EventChange::State;
    std::map<int, Open> still;
    for (const HmmTracker &tracker : m_chain.trackers()) {
        const Track &track = tracker.track();
        const bool isNew = track.id > m_lastId;
        Open open = isNew ? Open{.toldFrame = frame} : std::move(m_open.at(track.id));
        if (isNew)
            m_secondPass.keep(track);
        for (; open.keptPoints < track.points.size(); ++open.keptPoints)
            m_secondPass.keep(track.points[open.keptPoints].frame, track.points[open.keptPoints].cell);
        open.detectFrame = track.detectFrame;
        open.onsetFrame = track.onsetFrame;
        open.earliestEnd = tracker.earliestEnd();
        if (isNew || open.earliestEnd == frame)
            open.heard = eventNow(tracker, frame);
        open.heard.statistic = statisticOf(track, m_plan);
        open.heard.isConfirmed = track.isConfirmed;
        if (isNew)
            tell(State::Provisional, open.heard);
        if (track.isConfirmed && !open.isConfirmed) {
            tell(State::Confirmed, open.heard);
            open.toldFrame = frame;
        } else if (frame - open.toldFrame >= m_updateFrames) {
            tell(State::Updated, open.heard);
            open.toldFrame = frame;
        }
        open.isConfirmed = track.isConfirmed;
        still.emplace(track.id, std::move(open));
    }
    if (!still.empty())
        m_lastId = std::max(m_lastId, still.rbegin()->first);
    for (const auto &[id, open] : m_open) { // neither tracked nor ended: another track follows the same signal
        if (still.contains(id))
            continue;
        Event event;
        event.id = id;
        event.onsetSeconds = m_plan.time().value(double(open.onsetFrame));
        event.detectSeconds = m_plan.time().value(double(open.detectFrame));
        event.isConfirmed = open.isConfirmed;
        m_sink({State::Final, std::move(event), {}, true});
    }
    m_open = std::move(still);
}

void EventFollower::takeEnded()
{
    for (Track &track : m_chain.takeEnded()) {
        m_open.erase(track.id);
        m_secondPass.keep(track);
        tell(EventChange::State::Updated, eventSoFar(track));
        const int id = track.id;
        m_ended.emplace(id, std::move(track));
    }
}

/// Whether a track that this one could continue has not been joined yet.
bool EventFollower::isBlocked(const Track &track) const
{
    for (const auto &[id, open] : m_open)
        if (id < track.id && open.earliestEnd < track.detectFrame)
            return true;
    for (const auto &[id, ended] : m_ended)
        if (id < track.id && ended.endFrame < track.detectFrame
            && !isOutOfReach(ended.endFrame, track.onsetFrame, m_rule))
            return true;
    return false;
}

void EventFollower::joinWhatCan()
{
    for (auto next = m_ended.begin(); next != m_ended.end();) {
        if (isBlocked(next->second)) {
            ++next;
            continue;
        }
        const Event own = eventOf(next->second);
        const int id = joinTrack(m_joined, std::move(next->second), m_plan.grid(), m_rule);
        if (id != own.id) {
            m_sink({EventChange::State::Final, own, id, false});
            const Track &whole = *std::ranges::find(m_joined, id, &Track::id);
            m_secondPass.keep(whole);
            tell(EventChange::State::Updated, eventSoFar(whole));
        }
        next = m_ended.erase(next);
    }
}

/// Whether a track in progress, an ended one, or one starting at `firstOnset` or later may continue this track.
bool EventFollower::mayGoOn(const Track &track, Index firstOnset) const
{
    const auto reaches = [&](Index detectFrame, Index onsetFrame) {
        return detectFrame > track.endFrame && !isOutOfReach(track.endFrame, onsetFrame, m_rule);
    };
    return !isOutOfReach(track.endFrame, firstOnset, m_rule)
           || std::any_of(m_open.begin(), m_open.end(),
                          [&](const auto &open) { return reaches(open.second.detectFrame, open.second.onsetFrame); })
           || std::any_of(m_ended.begin(), m_ended.end(), [&](const auto &ended) {
                  return reaches(ended.second.detectFrame, ended.second.onsetFrame);
              });
}

void EventFollower::closeWhatCan(Index firstOnset, Index lastEnd)
{
    std::erase_if(m_joined, [&](const Track &track) {
        if (track.endFrame > lastEnd || mayGoOn(track, firstOnset))
            return false;
        if (std::optional<Event> left = m_secondPass.eventOf(track)) {
            tell(EventChange::State::Final, *left);
            m_final.push_back(*std::move(left));
        } else {
            m_sink({EventChange::State::Final, eventOf(track), {}, true});
        }
        return true;
    });
}

void EventFollower::finish()
{
    takeEnded();
    joinWhatCan();
    closeWhatCan(std::numeric_limits<Index>::max(), std::numeric_limits<Index>::max());
}

std::vector<Event> EventFollower::finalEvents() const
{
    std::vector<Event> all = m_final;
    for (Event &event : all)
        m_secondPass.complete(event);
    std::sort(all.begin(), all.end(), [](const Event &a, const Event &b) { return a.id < b.id; });
    sortEvents(all);
    return all;
}

} // namespace faintline
