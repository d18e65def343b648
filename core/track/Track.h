#pragma once

#include "base/Grid.h"
#include "track/constants.h"

#include <algorithm>
#include <vector>

namespace faintline {

/// Position of a followed signal in one frame.
struct TrackPoint {
    Index frame = 0;
    Index cell = 0;         ///< flat index on the frames' grid
    Index plane = 0;        ///< combination of rates, as in StateSpace
    double statistic = 0.0; ///< score of the path up to here, nat above background
    float offset = 0.0f;    ///< of a line from the cell's middle along the last axis, cells; 0 if not measured
};

/// Sets the offsets of the first `count` points of a path of a line from the evidence beside it in the frames around:
/// the vertex of the parabola through Σ λ in the cells below, on and above the path, over ±fittedPoints frames.
/// `lambda(i, cell)`: log-likelihood ratio in the frame of point i. λ is close to an amplitude, whose main lobe such a
/// parabola fits to 0.03 bin (Hann, two bins a cell).
template <class Lambda>
void measureOffsets(std::vector<TrackPoint> &path, std::size_t count, Lambda lambda)
{
    for (std::size_t i = 0; i < count; ++i) {
        double sums[3] = {};
        for (std::size_t j = i - std::min(i, fittedPoints); j < std::min(path.size(), i + fittedPoints + 1); ++j)
            for (Index d = -1; d <= 1; ++d)
                sums[d + 1] += double(lambda(j, path[j].cell + d));
        const double curvature = sums[0] - 2.0 * sums[1] + sums[2];
        if (curvature < 0.0)
            path[i].offset = float(std::clamp(0.5 * (sums[0] - sums[2]) / curvature, -0.5, 0.5));
    }
}

/// Removes the points before a new track's onset. A path usually reaches its signal through some frames of favourable
/// noise. The signal begins where the score begins to grow: the change point between no growth and half the path's own
/// mean growth,
///
///   onset = argmin_i s(i - 1) - i·s(n - 1)/2n,   s(-1) = 0,
///
/// for statistics s(0) … s(n - 1); the first of equals, and 0 if no value is below 0. `points`: not empty.
inline void trimOnset(std::vector<TrackPoint> &points)
{
    const double tilt = 0.5 * points.back().statistic / double(points.size());
    std::size_t onset = 0;
    double least = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const double before = i == 0 ? 0.0 : points[i - 1].statistic;
        const double tilted = before - tilt * double(i);
        if (tilted < least) {
            least = tilted;
            onset = i;
        }
    }
    points.erase(points.begin(), points.begin() + std::ptrdiff_t(onset));
}

/// Result of the two-sided second pass (refine/secondLook.h) for one point, along the last axis.
struct SmoothedPoint {
    double position = 0.0; ///< in cells, with subcell precision
    float low = 0.0f;      ///< 5 % quantile of the posterior, cells
    float high = 0.0f;     ///< 95 %
    float presence = 0.0f; ///< probability that the signal is present (BothWays::endsBy)
    float level = 0.0f;    ///< mean signal power over the noise's along the path

    /// Standard deviation of the position in cells, from the 5-95 % band, whose width is 3.29 deviations for a normal
    /// law; at least a tenth of a cell, because the posterior ignores the model's own errors.
    double deviation() const { return std::max(0.1, double(high - low) / 3.2897); }
};

/// From this frame on, a track belongs to another model of the bank (RivalModels.h).
struct ModelChange {
    Index frame = 0;
    std::size_t model = 0; ///< index in the bank

    bool operator==(const ModelChange &) const = default;
};

/// The model in a frame, after changes ordered by frame.
inline std::size_t modelAt(Index frame, std::size_t first, const std::vector<ModelChange> &changes)
{
    std::size_t model = first;
    for (const ModelChange &change : changes)
        if (change.frame <= frame)
            model = change.model;
    return model;
}

/// One signal from onset to end, and the decision that started it.
struct Track {
    int id = 0;                 ///< numbered from 1, in order of detection, then of cell
    Index onsetFrame = 0;       ///< where the detecting path's score began to grow
    Index detectFrame = 0;      ///< where the statistic first exceeded the threshold
    Index endFrame = 0;         ///< last frame with evidence
    double peakStatistic = 0.0; ///< largest score of the path, nat
    bool isConfirmed = false;
    bool isOpen = false;                   ///< still followed when the data ended
    std::vector<TrackPoint> points;        ///< onset … end, one per frame
    Index confirmFrame = -1;               ///< frame of the confirmation; -1: never
    std::size_t model = 0;                 ///< index of the bank's model that found it
    double detectStatistic = 0.0;          ///< the detector's statistic at the detection, in its own unit
    std::vector<SmoothedPoint> smoothed{}; ///< one per point; empty without the second pass
    double windowSeconds = 0.0; ///< T_FT of another window that found it (refine/otherWindows.h); 0: the frames' own
    bool isSubtracted = false;  ///< from the recording whose frames are displayed (refine/subtractLines.h)
    std::vector<ModelChange>
        modelChanges{}; ///< ordered by frame; the points' planes are those of the model at their frame

    bool hasSecondPass() const { return !smoothed.empty(); }

    /// Whether it has a point at a frame; and, if so, its index, and what the second pass made of it: its position in
    /// cells of the last axis, and all.
    bool isThere(Index frame) const
    {
        return !points.empty() && frame >= points.front().frame && frame <= points.back().frame;
    }
    std::size_t pointIndex(Index frame) const { return std::size_t(frame - points.front().frame); }
    double positionAt(Index frame) const { return smoothedAt(frame).position; }
    const SmoothedPoint &smoothedAt(Index frame) const { return smoothed[pointIndex(frame)]; }

    /// Whether the signal is more likely present than absent at a point; without the second pass, always.
    bool isPresent(std::size_t point) const { return !hasSecondPass() || smoothed[point].presence > 0.5f; }

    /// The points that reports and pictures contain: both ends, and those between at which the signal is present. A
    /// keyed or fading signal is one track with pauses, in which its position is not known. All points, if it is present
    /// at none.
    std::vector<std::size_t> presentPoints() const
    {
        bool isAnywhere = false;
        for (std::size_t i = 0; i < points.size(); ++i)
            isAnywhere = isAnywhere || isPresent(i);
        std::vector<std::size_t> result;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (!isAnywhere || i == 0 || i + 1 == points.size() || isPresent(i))
                result.push_back(i);
        return result;
    }

    /// Keeps the points `from` … `to` - 1, with onset and end there.
    void keepPoints(std::size_t from, std::size_t to)
    {
        isOpen = isOpen && to == points.size();
        const auto cut = [&](auto &values) {
            if (values.empty())
                return;
            values.erase(values.begin() + Index(to), values.end());
            values.erase(values.begin(), values.begin() + Index(from));
        };
        cut(points);
        cut(smoothed);
        takeEndsOfPoints();
    }

    /// Sets onset and end to the first and the last point.
    void takeEndsOfPoints()
    {
        onsetFrame = points.front().frame;
        endFrame = points.back().frame;
    }

    /// Moves detection and confirmation into the frames `first` … `last`, confirmation not before detection.
    void keepDecisionsIn(Index first, Index last)
    {
        detectFrame = std::clamp(detectFrame, first, last);
        if (confirmFrame >= 0)
            confirmFrame = std::clamp(confirmFrame, detectFrame, std::max(last, detectFrame));
    }

    /// The model that follows it at its newest point.
    std::size_t lastModel() const { return modelChanges.empty() ? model : modelChanges.back().model; }

    /// Position of a point along the last axis, in cells, as precisely as known.
    double lastPosition(std::size_t point, const Axis &axis) const
    {
        const Index cell = points[point].cell;
        return hasSecondPass() ? smoothed[point].position
                               : double(axis.count > 0 ? cell % axis.count : cell) + double(points[point].offset);
    }

    /// Position on all axes, in their units.
    std::vector<double> positionOf(std::size_t point, const Grid &grid) const
    {
        std::vector<double> position;
        const std::vector<Index> coordinates = grid.coordinates(points[point].cell);
        for (std::size_t axis = 0; axis + 1 < coordinates.size(); ++axis)
            position.push_back(grid.axes[axis].value(double(coordinates[axis])));
        position.push_back(grid.axes.back().value(lastPosition(point, grid.axes.back())));
        return position;
    }

    /// A copy without the per-frame values, which are not copied first.
    Track withoutPoints() const
    {
        return {id,           onsetFrame, detectFrame,     endFrame, peakStatistic, isConfirmed,  isOpen,      {},
                confirmFrame, model,      detectStatistic, {},       windowSeconds, isSubtracted, modelChanges};
    }
};

/// The track with that number; null if there is none.
inline const Track *trackOfId(const std::vector<Track> &tracks, int id)
{
    const auto found = std::find_if(tracks.begin(), tracks.end(), [id](const Track &track) { return track.id == id; });
    return found == tracks.end() ? nullptr : &*found;
}

} // namespace faintline
