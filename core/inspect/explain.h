#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <optional>
#include <vector>

namespace faintline {

/// Reason for the first frame of a path.
struct ResetCause {
    enum class Kind {
        Beginning,  ///< start of the recording
        Background, ///< the score before was below the background, so a restart was better
        Forgotten   ///< continuing would have been better, but the detector had forgotten a track's cells
    };
    Kind kind = Kind::Beginning;
    double lost = 0.0; ///< nat. Background: depth below 0 of continuing. Forgotten: the score given up
    int track = 0;     ///< Forgotten: number of the track
};

/// Explains the statistic of a cell: the best path that ends there, term by term.
struct Explanation {
    double seconds = 0.0;
    std::vector<double> position; ///< of the cell, one per axis
    std::vector<PathStep> steps;  ///< from the last reset on
    double offset = 0.0;          ///< added to all detector scores: K(t) under the mean law, minus a bank's o_i
    double statistic = 0.0;       ///< the sum of all terms and the offset, nat above background
    double displayed = 0.0;       ///< value shown by the analysis: the same, in single precision
    double threshold = 0.0;
    std::size_t model = 0;                 ///< index of the bank's model with which the path begins
    std::vector<ModelChange> modelChanges; ///< along the path, of the tracker that follows it

    /// The model of a step, which determines its state number.
    std::size_t modelAt(Index frame) const { return faintline::modelAt(frame, model, modelChanges); }
    ResetCause reset; ///< before the first step
    /// The best other state of the cell and its deficit, nat; absent for a model with one rate per cell.
    std::optional<Index> otherState;
    double otherMargin = 0.0;
    /// Track for which the cell was inhibited in this frame; 0: an excluded cell, -1: a track dropped later.
    std::optional<int> inhibitedFor;
    bool isSubtracted = false;       ///< on a subtracted line: the explanation is for the remainder (subtractLines.h)
    bool isExplainedByNoise = false; ///< on a path that the recording's own noise explains (ownNoiseLaw.h)
    /// A track through the cell that another window found, in which this statistic has no part (otherWindows.h).
    std::optional<int> otherWindowTrack;
    double otherWindowSeconds = 0.0; ///< T_FT of that window
    bool isTracked = false;          ///< a tracker follows this cell; its path continues without reset
};

/// Repeats an analysis's chain up to the frame nearest to `seconds` and traces the path to the cell nearest to
/// `position`. Throws Error if the time lies outside the recording; Cancelled.
Explanation explain(const Analysis &analysis, double seconds, const std::vector<double> &position,
                    const RunContext &context = {});

} // namespace faintline
