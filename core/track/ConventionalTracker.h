#pragma once

#include "base/Field.h"
#include "base/Grid.h"
#include "track/Track.h"

#include <deque>
#include <span>
#include <vector>

namespace faintline {

/// Decision rule of the conventional detector.
struct ConventionalSettings {
    double hitThreshold = 9.2;  ///< y of a hit, × noise: 10⁻⁴ of noise cells (Parsons 2008, Table 2)
    int hits = 3;               ///< M pings with a hit …
    int window = 5;             ///< … among the latest N
    double fastestCells = 20.0; ///< maximum speed along the first axis, cells per frame
    double fastestAcross = 1.0; ///< along the other axes

    static const std::vector<Field<ConventionalSettings>> &fields();
    bool operator==(const ConventionalSettings &) const = default;
};

/// Reference for track-before-detect: each frame is thresholded separately, then hits are associated.
///
///   hit:   y(cell) > hitThreshold
///   gate:  |hit - last hit| ≤ speed · (frames since) along every axis
///   track: M hits within N frames
///
/// The oldest track chooses first and takes the strongest hit in its gate, the lowest cell among equals. A hit outside
/// all gates starts a track, which is reported once it has M hits in N frames and ends when it can no longer reach M. A
/// track has a point for each hit; its statistic is the mean y of its M strongest hits. The gate, and with it the
/// number of false tracks, grows with the maximum speed, which is not so for a recursion over states. Source: Parsons
/// 2008, sections 1 and 4 (the processing he compares with). Oracle: hand-made matrices. Cost: one comparison per cell,
/// and hits × tracks. Use one object per thread.
class ConventionalTracker
{
public:
    ConventionalTracker(const Grid &grid, const ConventionalSettings &settings);

    /// Frames must be ascending, without gaps.
    void update(Index frame, std::span<const float> y);

    /// Reported tracks, including open ones, ordered by detection, then id.
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
