// Changes of the model that follows a track.

#include "base/logmath.h"
#include "track/HmmTracker.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    /// The plane of `to` with the rates nearest to those of a plane of `from`, in cells per step.
    Index nearestPlane(const StateSpace &from, Index plane, const StateSpace &to)
    {
        const std::vector<double> rates = from.ratesOfPlane(plane);
        Index result = 0;
        for (std::size_t i = 0; i < rates.size(); ++i) {
            const KinematicAxis &axis = to.axes()[i];
            const auto nearest = Index(std::llround(rates[i] * double(axis.ratesPerCell))) - axis.firstRate;
            result = result * axis.rateCount + std::clamp(nearest, Index(0), Index(axis.rateCount) - 1);
        }
        return result;
    }

} // namespace

HmmTracker HmmTracker::changedTo(TrackerModel &model, std::size_t number, double lnChange) const
{
    const Slice &last = m_history.back();
    const StateSpace &space = m_model->space;
    HmmTracker result = withoutPast(model);
    result.m_track.modelChanges.push_back({last.frame, number});
    result.m_lnChange = lnChange;
    result.m_statistic += lnChange;
    result.m_level += lnChange;
    result.m_best = nearestPlane(space, space.planeOf(m_best), model.space) * space.cellCount() + space.cellOf(m_best);
    Slice &slice = result.m_history.back();
    slice.offset += lnChange;
    slice.scores.assign(std::size_t(model.window.stateCount()), unreached);
    const Index cells = model.window.cellCount();
    for (Index plane = 0; plane < space.planeCount(); ++plane) {
        const Index other = nearestPlane(space, plane, model.space);
        for (Index cell = 0; cell < cells; ++cell) {
            float &score = slice.scores[std::size_t(other * cells + cell)];
            score = std::max(score, last.scores[std::size_t(plane * cells + cell)]);
        }
    }
    return result;
}

Index HmmTracker::stateBefore(Index state, const StateSpace &later) const
{
    const Slice &last = m_history.back();
    const StateSpace &space = m_model->space;
    float best = unreached;
    Index result = m_best;
    for (Index plane = 0; plane < space.planeCount(); ++plane) {
        if (nearestPlane(space, plane, later) != later.planeOf(state))
            continue;
        const Index candidate = plane * space.cellCount() + later.cellOf(state);
        const Index local = localOf(last, candidate);
        if (local >= 0 && last.scores[std::size_t(local)] > best) {
            best = last.scores[std::size_t(local)];
            result = candidate;
        }
    }
    return result;
}

void HmmTracker::changeTo(HmmTracker next)
{
    const Index frame = next.m_track.modelChanges.back().frame;
    const StateSpace &space = next.m_model->space;
    const TrackPoint start =
        next.m_track.points.empty() ? next.pathTo(next.m_best).front() : next.m_track.points.front();
    Track track = std::move(m_track);
    while (!track.points.empty() && track.points.back().frame >= frame)
        track.points.pop_back();
    while (!m_history.empty() && m_history.back().frame > frame)
        m_history.pop_back();
    if (!m_history.empty()) {
        const std::vector<TrackPoint> path = pathTo(stateBefore(start.plane * space.cellCount() + start.cell, space));
        track.points.insert(track.points.end(), path.begin(), path.end() - 1);
    }
    track.points.insert(track.points.end(), next.m_track.points.begin(), next.m_track.points.end());
    track.modelChanges = next.m_track.modelChanges;
    track.peakStatistic = std::max(track.peakStatistic, next.m_track.peakStatistic);
    if (!track.isConfirmed) {
        track.isConfirmed = next.m_track.isConfirmed;
        track.confirmFrame = next.m_track.confirmFrame;
    }
    next.m_track = std::move(track);
    next.m_beside = std::move(m_beside);
    if (!m_history.empty() && next.m_history.front().frame == frame)
        next.m_former = std::make_unique<HmmTracker>(std::move(*this));
    *this = std::move(next);
}

} // namespace faintline
