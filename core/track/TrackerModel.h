#pragma once

#include "base/Field.h"
#include "base/Grid.h"
#include "model/MarkovModel.h"
#include "recursion/Recursion.h"

#include <vector>

namespace faintline {

/// How a detected signal is followed and ended.
struct TrackSettings {
    std::vector<double> windowCells{12.0}; ///< half width of the tracking window, per axis (the last one repeats)
    double decayNats = 0.05;               ///< subtracted from the level in each frame, so that a track on noise fades
    double ceilingNats = 8.0;              ///< upper limit of the level above the threshold
    double endNats = 8.0;                  ///< a track ends when its level is this far below the threshold
    double confirmNats = 0.0;              ///< a track is confirmed this far above the threshold …
    int confirmFrames = 1;                 ///< … and at this age
    int smoothingFrames = 48;              ///< lag of the path's smoothing
    bool bothWays = true;                  ///< completed tracks get a two-sided second pass (refine/secondLook.h)

    static const std::vector<Field<TrackSettings>> &fields();
    bool operator==(const TrackSettings &) const = default;
};

/// Shared by all trackers of a chain: the model, the shape of the window, and scratch memory (one chain, one thread).
struct TrackerModel {
    TrackerModel(const MarkovModel &model, const Grid &grid, const TrackSettings &settings, double threshold);

    const StateSpace space;
    const Grid grid;
    const TrackSettings settings;
    const double threshold;
    const double transitionScale;
    std::vector<Index> halfWidth; ///< of the window, per axis
    std::vector<Index> reach;     ///< largest displacement in one step, per axis
    Index largestExtent = 0;      ///< cells beyond this distance cannot affect a tracker
    bool measuresOffsets = false; ///< TrackPoint::offset; of lines in a spectrogram
    StateSpace window;
    StateSpace padded; ///< the window extended by one step
    Recursion<MaxPlus<float>> recursion;
    std::vector<float> scores; ///< padded

    /// Grid cell of a cell of the window, or of the padded window, centred at `centre`; -1 off the grid.
    Index windowCell(const std::vector<Index> &centre, Index cell) const
    {
        return gridCell(centre, windowOffsets, cell);
    }
    Index paddedCell(const std::vector<Index> &centre, Index cell) const
    {
        return gridCell(centre, paddedOffsets, cell);
    }
    /// Cell of the padded window for a cell of a window shifted by `moved`; -1 outside.
    Index inPadded(Index cell, const std::vector<Index> &moved) const;

private:
    Index gridCell(const std::vector<Index> &centre, const std::vector<Index> &offsets, Index cell) const;

    std::vector<Index> windowOffsets; ///< from the centre, cell by cell, one per axis
    std::vector<Index> paddedOffsets;
};

} // namespace faintline
