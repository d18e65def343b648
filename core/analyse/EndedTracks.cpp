#include "analyse/EndedTracks.h"

#include "base/memoryShares.h"
#include "refine/TrackPiece.h"
#include "refine/secondLook.h"
#include "refine/trimEnds.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr std::size_t wholeFramesBytes = 4 * memoryShares::pathRecord; ///< some 180 frames of 180 000 cells

} // namespace

EndedTracks::EndedTracks(const AnalysisPlan &plan, Index openFrames) : m_plan(plan)
{
    const Index whole = openFrames + 2 * framesBeside();
    const std::size_t bytes = sizeof(float) * std::size_t(whole * plan.grid().size());
    if ((looksTwice(plan) || cutsOnly(plan)) && bytes <= wholeFramesBytes)
        m_frames =
            std::make_shared<LiveFrames>(plan.frames, whole, widestHalfWidth(plan.frames->geometry().binsPerCell));
}

Index EndedTracks::framesBeside()
{
    return TrackPiece::extraFrames;
}

void EndedTracks::take(Index frame, std::span<const float> y, double lnK)
{
    if (!m_frames)
        return;
    if (m_lnK.empty()) { // strips begin before the first frame
        m_firstLnK = std::max<Index>(0, frame - framesBeside());
        m_lnK.assign(std::size_t(frame - m_firstLnK), 0.0f);
    }
    m_frames->append(frame, y);
    m_lnK.push_back(float(lnK));
}

void EndedTracks::keep(Index frame, Index cell)
{
    if (m_frames)
        m_frames->mark(frame, cell);
}

void EndedTracks::keep(const Track &track, Index from)
{
    if (!m_frames)
        return;
    std::vector<TrackPiece> pieces;
    addPieces(pieces, track, m_frames->time().count, m_plan.frames->geometry().binsPerCell);
    for (const TrackPiece &piece : pieces)
        for (Index at = std::max<Index>(0, from - piece.strip.firstFrame); at < piece.strip.frameCount(); ++at)
            m_frames->mark(piece.strip.firstFrame + at, piece.strip.centres[std::size_t(at)]);
}

void EndedTracks::forgetBefore(Index frame)
{
    if (!m_frames)
        return;
    m_frames->forgetBefore(frame - framesBeside());
    constexpr Index together = 4096;
    if (const Index gone = m_frames->firstKept() - framesBeside() - m_firstLnK; gone >= together) {
        m_lnK.erase(m_lnK.begin(), m_lnK.begin() + gone);
        m_firstLnK += gone;
    }
}

AnalysisPlan EndedTracks::planSoFar() const
{
    AnalysisPlan plan = m_plan;
    plan.frames = m_frames;
    return plan;
}

std::optional<Event> EndedTracks::eventOf(const Track &track)
{
    // A chain that goes on with another threshold knows the onset of its tracks, but no longer their path.
    const bool isWhole = m_frames && track.onsetFrame >= std::max(m_frames->firstKept(), track.points.front().frame);
    if (!isWhole)
        return events(m_plan, {track}).front();
    Analysis analysis;
    static_cast<AnalysisPlan &>(analysis) = planSoFar();
    analysis.firstLnK = m_firstLnK;
    analysis.lnK.swap(m_lnK);
    std::vector<Track> left =
        looksTwice(analysis) ? lookTwice(analysis, {track}, {}, {}).tracks : cutToSignals(analysis, {track}, {});
    analysis.lnK.swap(m_lnK);
    std::ranges::for_each(left, trimEnds);
    return left.empty() ? std::nullopt : std::optional(events(analysis, left).front());
}

void EndedTracks::complete(Event &event) const
{
    if (!std::isnan(event.noiseProbability))
        event.noiseProbability = noiseProbability(event.statistic, planSoFar());
}

} // namespace faintline
