#include "live/LiveHistory.h"

#include "base/memoryShares.h"
#include "noise/CausalSpectrogram.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr std::size_t mostTracks = 256;
    constexpr std::size_t mostPoints = 512;
    constexpr Index shortestInterval = 64; ///< between checkpoints, in frames

    Axis from(Axis time, Index frame)
    {
        time.first = time.value(double(frame));
        return time;
    }

    std::vector<std::string> changedFields(const AnalysisSettings &before, const AnalysisSettings &after)
    {
        std::vector<std::string> names;
        for (const auto &field : AnalysisSettings::fields())
            if (field.get(before) != field.get(after))
                names.push_back(field.name);
        return names;
    }

    /// Half of the points, including the first and the last.
    void thinOut(std::vector<TrackPoint> &points)
    {
        std::size_t kept = 0;
        for (std::size_t i = 0; i + 1 < points.size(); i += 2)
            points[kept++] = points[i];
        points[kept++] = points.back();
        points.resize(kept);
    }

    /// Tracks are followed past their end, which becomes known only later.
    std::shared_ptr<Track> endingAt(Track track, Index frame)
    {
        while (track.points.size() > 1 && track.points.back().frame > frame)
            track.points.pop_back();
        return std::make_shared<Track>(std::move(track));
    }

} // namespace

LiveHistory::GrowingPicture::GrowingPicture(const Axis &axis, Index cells, ByteScale::Kind kind)
    : time(axis), fullFrames(singleFrames(cells)), all(time, cells, ByteScale(kind), memoryShares::picture),
      older(time, cells, ByteScale(kind)), younger(from(axis, fullFrames), cells, ByteScale(kind)),
      bytes(std::size_t(cells))
{
}

Index LiveHistory::singleFrames(Index cells)
{
    constexpr Index bytesACell = 4; // 1.33 × 3: twice as many frames in `older`, once in `younger`
    return std::max<Index>(1, Index(memoryShares::picture) / (bytesACell * cells));
}

void LiveHistory::GrowingPicture::append(std::span<const float> frame)
{
    all.scale().encode(frame, bytes);
    all.appendBytes(bytes);
    older.appendBytes(bytes);
    if (older.frameCount() > fullFrames)
        younger.appendBytes(bytes);
    if (younger.frameCount() < fullFrames)
        return;
    older = std::move(younger);
    younger = PeakPyramid(from(time, all.frameCount()), std::ssize(bytes), all.scale());
}

void LiveHistory::take(const AnalysisPlan &plan)
{
    const bool isSamePicture = m_plan && m_plan->frames == plan.frames;
    if (m_plan)
        markChange(plan, isSamePicture ? plan.time().value(double(m_input->all.frameCount())) : plan.time().first);
    m_plan = std::make_shared<const AnalysisPlan>(plan);
    beginStates(plan, isSamePicture ? m_input->all.frameCount() : 0);
    if (isSamePicture)
        return;
    m_input = std::make_unique<GrowingPicture>(plan.time(), plan.grid().size(), ByteScale::Kind::PowerDb);
    m_statistic = std::make_unique<GrowingPicture>(plan.time(), plan.grid().size(), ByteScale::Kind::ScoreNats);
    m_tracks.clear(); // their points refer to other frames
}

void LiveHistory::beginStates(const AnalysisPlan &plan, Index from)
{
    m_heldFrom = from;
    m_checkpoints = std::make_shared<Checkpoints<ChainState>>(shortestInterval, memoryShares::checkpoints);
    if (m_written)
        for (const NormalisedFramesPointer &line : plan.lines)
            static_cast<const CausalSpectrogram &>(*line).keepStates();
}

void LiveHistory::keepState(const ListenFrame &frame)
{
    const Index next = frame.number + 1;
    if (!m_written || !m_checkpoints->lacks(next))
        return;
    const auto state = frame.chain.state();
    if (!state)
        return;
    if (m_checkpoints.use_count() > 1) // shared with a view
        m_checkpoints = std::make_shared<Checkpoints<ChainState>>(*m_checkpoints);
    m_checkpoints->keep(next, state, state->bytes());
}

/// A later plan does not start at frame 0; its states are evenly spaced.
Index LiveHistory::goesBackTo() const
{
    if (m_heldFrom == 0)
        return 0;
    const Index first = (m_heldFrom / m_checkpoints->interval() + 1) * m_checkpoints->interval();
    return m_checkpoints->isEmpty() ? m_input->all.frameCount() : first;
}

void LiveHistory::markChange(const AnalysisPlan &plan, double seconds)
{
    AnalysisSettings after = plan.settings;
    after.selection.fromSeconds = m_plan->settings.selection.fromSeconds; // the restart time is not a user's setting
    if (std::vector<std::string> fields = changedFields(m_plan->settings, after); !fields.empty())
        m_changes.push_back({seconds, std::move(fields), plan.threshold});
}

void LiveHistory::take(const ListenFrame &frame)
{
    m_input->append(frame.y);
    m_statistic->append(frame.statistic);
    keepState(frame);
    m_heardAt = frame.heardAt;
    m_lostCount = frame.lostCount;
    for (const HmmTracker &tracker : frame.chain.trackers())
        follow(tracker, frame);
    while (m_tracks.size() > mostTracks)
        m_tracks.erase(m_tracks.begin());
}

void LiveHistory::follow(const HmmTracker &tracker, const ListenFrame &frame)
{
    std::shared_ptr<Track> &track = m_tracks[tracker.track().id + frame.idsBefore];
    if (!track)
        track = std::make_shared<Track>(tracker.track());
    else if (track.use_count() > 1) // shared with a view, which must not change
        track = std::make_shared<Track>(*track);
    track->id = tracker.track().id + frame.idsBefore;
    track->points.push_back({frame.number, tracker.cell(), 0, 0.0});
    if (track->points.size() > mostPoints)
        thinOut(track->points);
}

void LiveHistory::take(const EventChange &change)
{
    using State = EventChange::State;
    m_told.reset();
    const int id = change.event.id;
    if (change.partOf || change.isWithdrawn) {
        m_events.erase(id);
        m_tracks.erase(id);
        return;
    }
    const double confirmed = m_events.contains(id) ? m_events[id].confirmSeconds : change.event.confirmSeconds;
    Event &event = m_events[id] = change.event;
    if (event.isOpen)
        event.confirmSeconds = change.state == State::Confirmed ? event.endSeconds : confirmed;
    else if (m_tracks.contains(id))
        m_tracks[id] = endingAt(*m_tracks[id], m_plan->time().nearest(event.endSeconds));
}

LiveView LiveHistory::view() const
{
    if (!m_plan)
        return {};
    if (!m_told) {
        std::vector<Event> events;
        for (const auto &[id, event] : m_events)
            events.push_back(event);
        sortEvents(events);
        m_told = std::make_shared<const std::vector<Event>>(std::move(events));
    }
    const auto share = [](const PeakPyramid &picture) { return std::make_shared<const PeakPyramid>(picture.soFar()); };
    LiveView view{m_plan,
                  m_plan->time(),
                  share(m_input->all),
                  share(m_statistic->all),
                  share(m_input->older),
                  share(m_statistic->older),
                  m_told,
                  {},
                  m_changes,
                  m_written,
                  goesBackTo(),
                  m_checkpoints,
                  m_heardAt,
                  m_lostCount};
    view.time.count = m_input->all.frameCount();
    for (const auto &[id, track] : m_tracks)
        view.tracks.push_back(track);
    return view;
}

std::shared_ptr<const Analysis> analysisSoFar(const LiveView &view)
{
    if (!view.written || view.isEmpty())
        return nullptr;
    auto analysis = std::make_shared<Analysis>();
    static_cast<AnalysisPlan &>(*analysis) = *view.plan;
    // Only frames that exist.
    const Index samples = analysis->frames->geometry().endOf(view.time.count - 1);
    analysis->recording = std::make_shared<HeardRecording>(view.written, samples);
    for (NormalisedFramesPointer &line : analysis->lines)
        line = static_cast<const CausalSpectrogram &>(*line).over(analysis->recording);
    analysis->frames = familyFrames(analysis->lines, analysis->settings.family);
    analysis->input = view.input;
    analysis->statistic = view.statistic;
    analysis->checkpoints = *view.checkpoints;
    return analysis;
}

} // namespace faintline
