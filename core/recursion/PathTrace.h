#pragma once

#include "base/CellBox.h"
#include "model/MarkovModel.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace faintline {

/// One step of the best path: the terms of which its score is the sum.
struct PathStep {
    Index frame = 0;
    Index state = 0;
    double logLikelihoodRatio = 0.0; ///< λ of the state's cell, nat
    double lnTransition = 0.0;       ///< ln P(this | previous), 0 in the first step
    double lnK = 0.0;                ///< 0 in the first step
    double score = 0.0;              ///< sum of all terms so far, nat above background
    /// Margin of the winning predecessor over the second best, nat; ∞ without another, in the first step, and from
    /// `tracePath`, whose corridor does not contain all others.
    double runnerUp = std::numeric_limits<double>::infinity();
};

/// Input of the recursion, for repeating it. Frames are requested in ascending order.
struct RecursionRecord {
    Index firstFrame = 0;                                           ///< oldest recorded frame
    std::function<std::span<const float>(Index frame)> frame;       ///< y as the detector saw it
    std::function<double(Index frame)> lnK;                         ///< for the step into that frame
    std::function<std::span<const CellBox>(Index frame)> forgotten; ///< boxes forgotten after that frame

    /// Scores of all states after a frame, before anything is forgotten.
    struct Checkpoint {
        Index frame = -1; ///< -1 if there is no checkpoint
        std::span<const float> scores{};
    };
    /// The latest stored one before `frame`. May be empty: none are stored.
    std::function<Checkpoint(Index frame)> checkpoint{};
};

/// End of a path.
struct PathEnd {
    Index frame;
    Index state;
    double score; ///< as given by the detector
};

/// The best path with this end, from its last reset on, oldest step first.
///
/// Repeats the recursion in a corridor that grows until it begins at a checkpoint or reproduces the detector's own
/// score of that state, so the detector itself needs no back-pointers. Between checkpoints the cost does not depend on
/// the path's length. A path older than the record begins with the record. Source: Billon 2005 section 3 (τₙ, the
/// latest reset). Oracle: enumeration of all paths.
std::vector<PathStep> tracePath(const MarkovModel &model, const Grid &grid, const RecursionRecord &record, PathEnd end);

/// The score of each state's best path, and a number that the path brings along.
struct CarriedPaths {
    std::vector<float> scores;
    std::vector<std::int32_t> carried;
};

/// One step of the recursion, which carries the numbers along, before a reset: scores and ties are those of the recursion
/// if the law is the same in all cells. `scratch` keeps memory between calls.
void carryAlong(const MarkovModel &model, Index step, CarriedPaths &paths, CarriedPaths &scratch);

} // namespace faintline
