#pragma once

#include "base/Grid.h"

#include <limits>
#include <vector>

namespace faintline {

/// Where a followed signal was in one frame.
struct TrackPoint {
    Index frame = 0;
    Index cell = 0;         ///< flat index on the frames' grid
    Index plane = 0;        ///< combination of rates, as in StateSpace
    double statistic = 0.0; ///< score of the path up to here, nat above background

    // Known of tracks that were looked at from both ends (secondLook.h), along the last axis:
    double position = std::numeric_limits<double>::quiet_NaN(); ///< in cells, below one
    float low = std::numeric_limits<float>::quiet_NaN();        ///< 5 % of the posterior, cells
    float high = std::numeric_limits<float>::quiet_NaN();       ///< 95 %
    float presence = std::numeric_limits<float>::quiet_NaN();   ///< probability that the signal is there
    float level = std::numeric_limits<float>::quiet_NaN();      ///< its mean power over the noise's along the path
};

/// Where a point is along the last axis, in cells, as exactly as is known.
inline double lastPosition(const TrackPoint &point, const Axis &axis)
{
    return point.position == point.position ? point.position
                                            : static_cast<double>(axis.count > 0 ? point.cell % axis.count : point.cell);
}

/// The same on all axes, in their units.
inline std::vector<double> positionOf(const TrackPoint &point, const Grid &grid)
{
    std::vector<double> position;
    const std::vector<Index> coordinates = grid.coordinates(point.cell);
    for (std::size_t axis = 0; axis + 1 < coordinates.size(); ++axis)
        position.push_back(grid.axes[axis].value(static_cast<double>(coordinates[axis])));
    position.push_back(grid.axes.back().value(lastPosition(point, grid.axes.back())));
    return position;
}

/// One signal from its onset to its end, and the decision that started it.
struct Track {
    int id = 0;              ///< counted from 1, in order of detection, then of cell
    Index onsetFrame = 0;    ///< where the detecting path's score began to grow
    Index detectFrame = 0;   ///< where the statistic first exceeded the threshold
    Index endFrame = 0;      ///< last frame with evidence
    double peakStatistic = 0.0; ///< largest score of the path, nat
    bool isConfirmed = false;
    bool isOpen = false;     ///< still followed when the data ended
    std::vector<TrackPoint> points; ///< onset … end, one per frame
    Index confirmFrame = -1; ///< where it was confirmed, -1: never
    std::size_t model = 0;   ///< which of a bank's models found it and follows it
    double detectStatistic = 0.0; ///< the detector's, in its own unit, where it was detected

    /// All but the points, without copying them first.
    Track withoutPoints() const
    {
        return {id, onsetFrame, detectFrame, endFrame, peakStatistic, isConfirmed, isOpen, {}, confirmFrame, model, detectStatistic};
    }
};

} // namespace faintline
