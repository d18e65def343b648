#pragma once

#include "base/Field.h"
#include "base/Grid.h"
#include "track/Track.h"

#include <deque>
#include <span>
#include <vector>

namespace faintline {

/// How the conventional detector decides.
struct ConventionalSettings {
    double hitThreshold = 9.2;  ///< y of a hit, × noise: 10⁻⁴ of noise cells (Parsons 2008, Table 2)
    int hits = 3;               ///< M pings with a hit …
    int window = 5;             ///< … among the latest N
    double fastestCells = 20.0; ///< largest speed along the first axis, cells a frame
    double fastestAcross = 1.0; ///< along the other axes

    static const std::vector<Field<ConventionalSettings>> &fields();
    bool operator==(const ConventionalSettings &) const = default;
};

/// What track-before-detect is held against: each frame is thresholded by itself, then hits are put together.
///
///   hit:   y(cell) > hitThreshold
///   gate:  |hit - last hit| ≤ speed · (frames since) along every axis
///   track: M hits within N frames
///
/// The oldest track chooses first and takes the strongest hit of its gate, the lowest cell among equals; a hit that no
/// gate took starts a track, which is reported once it has M hits in N frames and ends when it can have so many no
/// more. It has a point for each hit; its statistic is the mean y of its M strongest hits. The gate grows with the
/// largest speed, and false tracks with it: a price that a recursion over states does not pay. Source: Parsons 2008,
/// sections 1 and 4 (the processing he compares with). Oracle: matrices by eye. Cost: one comparison a cell, and hits ×
/// tracks. One object per thread.
class ConventionalTracker
{
public:
    ConventionalTracker(const Grid &grid, const ConventionalSettings &settings);

    /// Frames ascending, without gaps.
    void update(Index frame, std::span<const float> y);

    /// Reported tracks, ordered by detection, then id; those still open included.
    std::vector<Track> tracks() const;

private:
    struct Candidate {
        Track track;
        std::deque<bool> recent; ///< whether there was a hit, latest last, at most N
        std::vector<float> powers;
        bool isReported = false;

        int recentHits() const;
    };
    struct Hit {
        Index cell = 0;
        float y = 0.0f;
        bool isTaken = false;
    };

    bool isInGate(const TrackPoint &from, Index frame, Index cell) const;
    Hit *strongestInGate(const TrackPoint &from, Index frame, std::vector<Hit> &hits) const;
    void take(Candidate &candidate, Index frame, const Hit &hit);
    void drop(Index frame);

    Grid m_grid;
    ConventionalSettings m_settings;
    std::vector<Candidate> m_candidates; ///< oldest first
    std::vector<Track> m_ended;
    int m_nextId = 1;
};

} // namespace faintline
