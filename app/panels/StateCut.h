#pragma once

#include "analysis/StateReplay.h"
#include "app/control/FramePlace.h"
#include "widgets/waterfall/SliceMarks.h"

#include <QString>

#include <memory>
#include <vector>

namespace faintline {

/// A slice through the states of one frame, laid through a cell, and what can be said of it.
struct StateCut {
    /// Which one.
    struct Wanted {
        FramePlace place;
        StateSlice slice; ///< its axes; those that are not shown follow from the place
        std::size_t model = 0;
        bool isMaximised = false; ///< over the axes that are not shown; otherwise they stand at the place
    };

    StateSlice slice;
    std::vector<Axis> axes; ///< of all states; the slope of lines in a unit that suits it
    std::shared_ptr<const PeakPyramid> picture;
    std::vector<float> scores;  ///< rows × columns, nat
    std::vector<double> values; ///< of the cell's best state, one per axis
    std::size_t model = 0;
    Index frame = 0;
    double best = 0.0;

    const Axis &rows() const { return axes[slice.rows]; }
    const Axis &columns() const { return axes[slice.columns]; }
    double score(Index row, Index column) const { return double(scores[std::size_t(row * columns().count + column)]); }
    double scoreAtCursor() const;

    /// The best state that can be seen.
    std::optional<SliceMarks::Best> bestIn(const Viewport::Box &visible) const;
    /// Where the paths of these tracks lie in the slice.
    std::vector<Viewport::Point> pathsOf(const std::vector<Track> &tracks, const Analysis &analysis) const;
    /// Where the axes that are not shown stand.
    QString otherWords() const;
    /// Of lines: the best state of the cursor's cell, and what the marks stand for.
    QString bestWords(const SliceMarks &marks) const;
};

/// Goes through the run again to the frame of that place. Throws Error where the detector has no states, and Cancelled.
StateCut cutThrough(StateReplay &replay, const StateCut::Wanted &wanted, const RunContext &context);

} // namespace faintline
