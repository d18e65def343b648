#pragma once

#include "detect/Detector.h"
#include "model/MarkovModel.h"

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace faintline {

/// One step of the best path: the terms that its score is the sum of.
struct PathStep {
    Index frame = 0;
    Index state = 0;
    double logLikelihoodRatio = 0.0; ///< λ of the state's cell, nat
    double lnTransition = 0.0;       ///< ln P(this | previous), 0 in the first step
    double lnK = 0.0;                ///< 0 in the first step
    double score = 0.0;              ///< sum of all terms so far, nat above background
    /// How far the second best predecessor lay behind the one that won, nat; ∞ where there was no other, in the first
    /// step, and in what `tracePath` gives, whose corridor does not know all others.
    double runnerUp = std::numeric_limits<double>::infinity();
};

/// What the recursion saw, for going through it again. Frames are asked for in ascending order.
struct RecursionRecord {
    Index firstFrame = 0;                                           ///< oldest frame that is still known
    std::function<std::span<const float>(Index frame)> frame;       ///< y as the detector saw it
    std::function<double(Index frame)> lnK;                         ///< in force for the step into that frame
    std::function<std::span<const CellBox>(Index frame)> forgotten; ///< boxes forgotten after that frame

    /// The scores of all states after a frame, before anything was forgotten.
    struct Checkpoint {
        Index frame = -1; ///< -1 if there is no checkpoint
        std::span<const float> scores{};
    };
    /// The latest that was kept of the frames before `frame`. May be empty: none are kept.
    std::function<Checkpoint(Index frame)> checkpoint{};
};

/// Where a path ends.
struct PathEnd {
    Index frame;
    Index state;
    double score; ///< the detector's own
};

/// The best path that ends there, from its last reset on, oldest step first.
///
/// Goes through the recursion again in a corridor that grows until it begins at a checkpoint or finds the detector's
/// own score for that state, so the detector itself keeps no back-pointers. From one checkpoint to the next the cost
/// is the same however long the path is. A path older than the record begins with the record. Source: Billon 2005
/// section 3 (τₙ, the latest reset). Oracle: enumeration of all paths.
std::vector<PathStep> tracePath(const MarkovModel &model, const Grid &grid, const RecursionRecord &record, PathEnd end);

} // namespace faintline
