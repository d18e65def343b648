#pragma once

#include "analysis/analyse.h"
#include "detect/PathTrace.h"

#include <optional>
#include <vector>

namespace faintline {

/// Why a path begins where it does.
struct ResetCause {
    enum class Kind {
        Beginning,  ///< with the recording
        Background, ///< what came before stood below the background: starting afresh was better
        Forgotten   ///< going on would have been better, had the detector not forgotten what a track had taken over
    };
    Kind kind = Kind::Beginning;
    double lost = 0.0; ///< Background: how far below 0 going on would have begun, nat. Forgotten: what was given up
    int track = 0;     ///< Forgotten: for which one
};

/// Why a cell has the statistic it has: the best path that ends there, term by term.
struct Explanation {
    double seconds = 0.0;
    std::vector<double> position; ///< of the cell, one per axis
    std::vector<PathStep> steps;  ///< from the last reset on
    double offset = 0.0;          ///< added to all of the detector's scores: K(t) under the mean law, less a bank's o_i
    double statistic = 0.0;       ///< the sum of all terms and the offset, nat above background
    double displayed = 0.0;       ///< what the analysis shows there: the same, in single precision
    double threshold = 0.0;
    std::size_t model = 0; ///< of a bank, the one whose path it is: it numbers the steps' states
    ResetCause reset;      ///< before the first step
    /// The best of the other states of the cell and how far it lies behind, nat; absent for a model with one rate per
    /// cell.
    std::optional<Index> otherState;
    double otherMargin = 0.0;
    /// The track for which the cell was kept from the detector in this frame; 0: a blind place, -1: one dropped later.
    std::optional<int> inhibitedFor;
    bool isSubtracted = false;       ///< on a line that was subtracted: what is explained is the rest (subtractLines.h)
    bool isExplainedByNoise = false; ///< on a path that the recording's own noise explains (overOwnNoise.h)
    bool isTracked = false;          ///< a tracker follows this cell; its path runs on without reset
};

/// Runs an analysis's chain again up to the frame nearest to `seconds` and traces the path to the cell nearest to
/// `position`. Throws Error where the time lies outside of the recording; Cancelled.
Explanation explain(const Analysis &analysis, double seconds, const std::vector<double> &position,
                    const RunContext &context = {});

} // namespace faintline
