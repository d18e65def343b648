#pragma once

#include "app/document/FramePlace.h"
#include "inspect/StateReplay.h"
#include "widgets/waterfall/SliceMarks.h"

#include <QString>

#include <memory>
#include <vector>

namespace faintline {

/// A slice through the states of one frame at a cell, and its description.
struct StateCut {
    /// Selection of a slice.
    struct Wanted {
        FramePlace place;
        StateSlice slice; ///< its axes; the other ones are fixed at the position
        std::size_t model = 0;
        bool isMaximised = false; ///< over the axes that are not shown; otherwise they are fixed at the position
        bool operator==(const Wanted &) const = default;
    };

    StateSlice slice;
    std::vector<Axis> axes; ///< for all states; the slope of lines is in a suitable unit
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

    /// The best visible state.
    std::optional<SliceMarks::Best> bestIn(const Viewport::Box &visible) const;
    /// Positions of these tracks' paths in the slice.
    std::vector<Viewport::Point> pathsOf(const std::vector<Track> &tracks, const Analysis &analysis) const;
    /// Text for the positions of the axes that are not shown.
    QString otherWords() const;
    /// For lines: text for the best state of the cursor's cell, and the key of the marks.
    QString bestWords(const SliceMarks &marks) const;
};

/// Repeats the run up to the frame of that position. Throws Error if the detector has no states, and Cancelled.
StateCut cutThrough(StateReplay &replay, const StateCut::Wanted &wanted, const RunContext &context);

} // namespace faintline
