#pragma once

#include "detect/joinKernels.h"

namespace faintline {

/// What of the states in some cells went on.
struct Continued {
    Index count = 0;
    double sum = 0.0; ///< Σ max(M + ln K, 0)
};

/// One target plane of `finishMax`: where its predecessors' scores and its own lie.
struct TargetPlane {
    std::span<const ShiftedPlane<float>> sources;
    float *to;
};

/// How much of `Continued` is wanted.
enum class Counting { Nothing, States, StatesAndSum };

/// What follows M in one frame: u = λ + max(M + ln K, floor).
struct FrameJoin {
    float lnK = 0.0f;
    float floor = 0.0f; ///< 0, or -∞ for no reset
    Counting counting = Counting::States;
    bool isFresh = false; ///< D begins at -∞; else at what it holds
    /// Rows that will be wanted soon: their cell i is fetched while cell i is joined.
    std::span<const float *const> ahead{};
};

/// Some cells, and where the first of them lies in the sources' planes and in the targets'.
struct CellRun {
    Index count = 0;
    Index inSources = 0;
    Index inTargets = 0;
};

/// The maximum over the sources of every target, joined with the frame at once, cell by cell for all targets, so that λ
/// and D are read and written once:
///
///   u_k[i] = λ[i] + max(M_k[i] + ln K, floor),   D[i] = max(D[i], max_k u_k[i])
///
/// `lambda` and `statistic` hold the run's cells alone. Counts the states with u > λ if asked to. Bits do not depend on
/// the instruction set; those of the sum depend on where a row is cut into calls. A target without sources has M = -∞.
Continued finishMax(std::span<const TargetPlane> targets, const CellRun &cells, const float *lambda,
                    const FrameJoin &join, float *statistic);

} // namespace faintline
