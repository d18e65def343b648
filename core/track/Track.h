#pragma once

#include "base/Grid.h"

#include <algorithm>
#include <vector>

namespace faintline {

/// Where a followed signal was in one frame.
struct TrackPoint {
    Index frame = 0;
    Index cell = 0;         ///< flat index on the frames' grid
    Index plane = 0;        ///< combination of rates, as in StateSpace
    double statistic = 0.0; ///< score of the path up to here, nat above background
};

/// What the look from both ends knows of a point (analysis/secondLook.h), along the last axis.
struct SmoothedPoint {
    double position = 0.0; ///< in cells, below one
    float low = 0.0f;      ///< 5 % of the posterior, cells
    float high = 0.0f;     ///< 95 %
    float presence = 0.0f; ///< probability that the signal is there
    float level = 0.0f;    ///< its mean power over the noise's along the path

    /// Standard deviation of the position, in cells, by the 5-95 % band, which is 3.29 of them wide for a normal law;
    /// at least a tenth of a cell, for the posterior knows nothing of what its model leaves out.
    double deviation() const { return std::max(0.1, double(high - low) / 3.2897); }
};

/// One signal from its onset to its end, and the decision that started it.
struct Track {
    int id = 0;                 ///< counted from 1, in order of detection, then of cell
    Index onsetFrame = 0;       ///< where the detecting path's score began to grow
    Index detectFrame = 0;      ///< where the statistic first exceeded the threshold
    Index endFrame = 0;         ///< last frame with evidence
    double peakStatistic = 0.0; ///< largest score of the path, nat
    bool isConfirmed = false;
    bool isOpen = false;                   ///< still followed when the data ended
    std::vector<TrackPoint> points;        ///< onset … end, one per frame
    Index confirmFrame = -1;               ///< where it was confirmed, -1: never
    std::size_t model = 0;                 ///< which of a bank's models found it and follows it
    double detectStatistic = 0.0;          ///< the detector's, in its own unit, where it was detected
    std::vector<SmoothedPoint> smoothed{}; ///< one per point; empty without the second pass
    double windowSeconds = 0.0; ///< of the longer window that found it (analysis/steadyLines.h); 0: the frames' own
    bool isSubtracted = false;  ///< from the recording whose frames are shown (analysis/subtractLines.h)

    /// Where a point is along the last axis, in cells, as exactly as is known.
    double lastPosition(std::size_t point, const Axis &axis) const
    {
        const Index cell = points[point].cell;
        return !smoothed.empty() ? smoothed[point].position : double(axis.count > 0 ? cell % axis.count : cell);
    }

    /// The same on all axes, in their units.
    std::vector<double> positionOf(std::size_t point, const Grid &grid) const
    {
        std::vector<double> position;
        const std::vector<Index> coordinates = grid.coordinates(points[point].cell);
        for (std::size_t axis = 0; axis + 1 < coordinates.size(); ++axis)
            position.push_back(grid.axes[axis].value(double(coordinates[axis])));
        position.push_back(grid.axes.back().value(lastPosition(point, grid.axes.back())));
        return position;
    }

    /// All but what there is for each frame, without copying them first.
    Track withoutPoints() const
    {
        return {id,           onsetFrame, detectFrame,     endFrame, peakStatistic, isConfirmed, isOpen, {},
                confirmFrame, model,      detectStatistic, {},       windowSeconds, isSubtracted};
    }
};

/// The track of that number; null where there is none.
inline const Track *trackOfId(const std::vector<Track> &tracks, int id)
{
    const auto found = std::find_if(tracks.begin(), tracks.end(), [id](const Track &track) { return track.id == id; });
    return found == tracks.end() ? nullptr : &*found;
}

} // namespace faintline
