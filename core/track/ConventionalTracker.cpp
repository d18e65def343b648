#include "track/ConventionalTracker.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

const std::vector<Field<ConventionalSettings>> &ConventionalSettings::fields()
{
    using S = ConventionalSettings;
    static const std::vector<Field<S>> table{
        field(&S::hitThreshold, "hitThreshold", "× noise", 0.0, 1e6,
              "Power above which a cell of a ping is a hit of the conventional detector.")
            .advised("Lower it for weaker echoes. Noise has a hit in a fraction e^-threshold of the cells."),
        field(&S::hits, "hits", "pings", 1.0, 1000.0, "M: number of pings with a hit that form a conventional track.")
            .advised("Raise it for fewer false tracks. Targets are then detected later."),
        field(&S::window, "window", "pings", 1.0, 1000.0, "N: number of latest pings that must contain these hits.")
            .advised("Lengthen it for echoes that fade. Noise then forms more tracks."),
        field(&S::fastestCells, "fastestCells", "cells/ping", 0.0, 1e5, "Largest range rate that the gate admits.")
            .advised("Raise it for faster targets. The gate then admits more hits of noise."),
        field(&S::fastestAcross, "fastestAcross", "cells/ping", 0.0, 1e5, "Largest bearing rate that the gate admits.")
            .advised("Raise it for targets that cross close to the sonar. The gate then admits more hits of noise."),
    };
    return table;
}

int ConventionalTracker::Candidate::recentHits() const
{
    return int(std::count(recent.begin(), recent.end(), true));
}

ConventionalTracker::ConventionalTracker(const Grid &grid, const ConventionalSettings &settings)
    : m_grid(grid), m_settings(settings)
{
}

bool ConventionalTracker::isInGate(const TrackPoint &from, Index frame, Index cell) const
{
    const auto frames = double(frame - from.frame);
    const std::vector<Index> a = m_grid.coordinates(from.cell);
    const std::vector<Index> b = m_grid.coordinates(cell);
    for (std::size_t axis = 0; axis < a.size(); ++axis) {
        const Index distance = std::abs(m_grid.axes[axis].steps(a[axis], b[axis]));
        if (double(distance) > frames * (axis == 0 ? m_settings.fastestCells : m_settings.fastestAcross))
            return false;
    }
    return true;
}

ConventionalTracker::Hit *ConventionalTracker::strongestInGate(const TrackPoint &from, Index frame,
                                                               std::vector<Hit> &hits) const
{
    Hit *best = nullptr;
    for (Hit &hit : hits)
        if (!hit.isTaken && (!best || hit.y > best->y) && isInGate(from, frame, hit.cell))
            best = &hit;
    return best;
}

void ConventionalTracker::take(Candidate &candidate, Index frame, const Hit &hit)
{
    Track &track = candidate.track;
    candidate.powers.push_back(hit.y);
    std::vector<float> strongest = candidate.powers;
    std::sort(strongest.begin(), strongest.end(), std::greater<>());
    strongest.resize(std::min(strongest.size(), std::size_t(m_settings.hits)));
    track.peakStatistic =
        std::accumulate(strongest.begin(), strongest.end(), 0.0, [](double sum, float y) { return sum + double(y); })
        / double(strongest.size());
    track.detectStatistic = track.peakStatistic;
    track.points.push_back({frame, hit.cell, 0, double(hit.y)});
    track.endFrame = frame;
}

void ConventionalTracker::update(Index frame, std::span<const float> y)
{
    std::vector<Hit> hits;
    for (std::size_t cell = 0; cell < y.size(); ++cell)
        if (double(y[cell]) > m_settings.hitThreshold)
            hits.push_back({Index(cell), y[cell], false});
    for (Candidate &candidate : m_candidates) {
        Hit *hit = strongestInGate(candidate.track.points.back(), frame, hits);
        candidate.recent.push_back(hit != nullptr);
        if (std::ssize(candidate.recent) > m_settings.window)
            candidate.recent.pop_front();
        if (hit) {
            hit->isTaken = true;
            take(candidate, frame, *hit);
        }
    }
    for (const Hit &hit : hits)
        if (!hit.isTaken) {
            Candidate fresh;
            fresh.track.onsetFrame = frame;
            fresh.recent.push_back(true);
            take(fresh, frame, hit);
            m_candidates.push_back(std::move(fresh));
        }
    drop(frame);
}

void ConventionalTracker::drop(Index frame)
{
    std::vector<Candidate> going;
    for (Candidate &candidate : m_candidates) {
        const int found = candidate.recentHits();
        if (!candidate.isReported && found >= m_settings.hits) {
            candidate.isReported = true;
            candidate.track.id = m_nextId++;
            candidate.track.detectFrame = candidate.track.confirmFrame = frame;
            candidate.track.isConfirmed = true;
        }
        // Hits that can still count towards the window: all of a young candidate's, all but the oldest of an old one's.
        const int frames = int(candidate.recent.size());
        const bool isHopeless = found + (m_settings.window - frames) < m_settings.hits;
        if (!isHopeless)
            going.push_back(std::move(candidate));
        else if (candidate.isReported)
            m_ended.push_back(std::move(candidate.track));
    }
    m_candidates = std::move(going);
}

std::vector<Track> ConventionalTracker::tracks() const
{
    std::vector<Track> all = m_ended;
    for (const Candidate &candidate : m_candidates)
        if (candidate.isReported) {
            all.push_back(candidate.track);
            all.back().isOpen = true;
        }
    std::sort(all.begin(), all.end(), [](const Track &a, const Track &b) { return a.id < b.id; });
    return all;
}

} // namespace faintline
