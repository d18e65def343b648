#pragma once

#include "base/Axis.h"

#include <span>

namespace faintline {

/// A source plane, shifted to the target's cells.
template <class Real>
struct ShiftedPlane {
    const Real *from;
    Real weight;
};

// Inner loops of the recursion, compiled for each instruction set.

/// to[i] = max_k from_k[i] + weight_k; -∞ without sources.
void joinMax(float *to, Index n, std::span<const ShiftedPlane<float>> sources);
void joinMax(double *to, Index n, std::span<const ShiftedPlane<double>> sources);

/// to[i] = Σ_k from_k[i]·weight_k, in the order of the sources; 0 without sources.
void joinSum(double *to, Index n, std::span<const ShiftedPlane<double>> sources);

void maxOfTwo(float *to, const float *a, const float *b, Index n);
void maxOfTwo(double *to, const double *a, const double *b, Index n);

/// to[i] += more[i], to[i] *= factors[i].
void addEach(float *to, const float *more, Index n);
void addEach(double *to, const double *more, Index n);
void multiplyEach(double *to, const double *factors, Index n);

} // namespace faintline
