#pragma once

#include "base/Axis.h"

#include <span>

namespace faintline {

/// A source plane, moved to where its values are needed.
template <class Real>
struct ShiftedPlane {
    const Real *from;
    Real weight;
};

// The inner loops of the recursion, compiled for each instruction set.

/// to[i] = max_k from_k[i] + weight_k; with no source -∞.
void joinMax(float *to, Index n, std::span<const ShiftedPlane<float>> sources);
void joinMax(double *to, Index n, std::span<const ShiftedPlane<double>> sources);

/// to[i] = Σ_k from_k[i]·weight_k, the sources in their order; with none 0.
void joinSum(double *to, Index n, std::span<const ShiftedPlane<double>> sources);

void maxOfTwo(float *to, const float *a, const float *b, Index n);
void maxOfTwo(double *to, const double *a, const double *b, Index n);

/// to[i] += more[i], to[i] *= factors[i].
void addEach(float *to, const float *more, Index n);
void addEach(double *to, const double *more, Index n);
void multiplyEach(double *to, const double *factors, Index n);

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

/// The maximum over the sources of every target, joined with the frame at once, cell by cell for all targets, so that λ
/// and D are read and written once:
///
///   u_k[i] = λ[i] + max(M_k[i] + ln K, floor),   D[i] = max(D[i], max_k u_k[i])
///
/// Sources are read from `sourceOffset` + i, scores written to `targetOffset` + i, i = 0 … n-1. Counts those with u > λ
/// if asked to. Bits do not depend on the instruction set; those of the sum depend on where a row is cut into calls. A
/// target without sources has M = -∞.
Continued finishMax(std::span<const TargetPlane> targets, Index n, Index sourceOffset, Index targetOffset,
                    const float *lambda, const FrameJoin &join, float *statistic);

} // namespace faintline
