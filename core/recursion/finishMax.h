#pragma once

#include "recursion/joinKernels.h"

namespace faintline {

/// States that continued, in some cells.
struct Continued {
    Index count = 0;
    double sum = 0.0; ///< Σ max(M + ln K, 0)
};

/// One target plane of `finishMax`: its predecessors' scores and its own.
struct TargetPlane {
    std::span<const ShiftedPlane<float>> sources;
    float *to;
};

/// Which members of `Continued` to compute.
enum class Counting { Nothing, States, StatesAndSum };

/// How M is joined with one frame: u = λ + max(M + ln K, floor).
struct FrameJoin {
    float lnK = 0.0f;
    float floor = 0.0f; ///< 0, or -∞ for no reset
    Counting counting = Counting::States;
    bool isFresh = false; ///< D starts at -∞; else at its current value
    /// Rows needed soon: cell i of each is prefetched while cell i is joined.
    std::span<const float *const> ahead{};
};

/// A run of cells and the position of its first cell in the sources' and the targets' planes.
struct CellRun {
    Index count = 0;
    Index inSources = 0;
    Index inTargets = 0;
};

/// Computes the maximum over the sources of each target and joins it with the frame, cell by cell for all targets, so
/// that λ and D are read and written once:
///
///   u_k[i] = λ[i] + max(M_k[i] + ln K, floor),   D[i] = max(D[i], max_k u_k[i])
///
/// `lambda` and `statistic` hold the run's cells only. Counts the states with u > λ on request. Results do not depend
/// on the instruction set; the sum depends on where a row is divided into calls. A target without sources has M = -∞.
Continued finishMax(std::span<const TargetPlane> targets, const CellRun &cells, const float *lambda,
                    const FrameJoin &join, float *statistic);

} // namespace faintline
