#pragma once

#include "base/Axis.h"

#include <span>

namespace faintline {

/// Divides every cell by the mean of its neighbours, for noise whose power is not known (cell-averaging CFAR).
///
///   y(i) ← y(i) / [ 1/N Σ y(j) ],   j: the N cells nearest to i on its row, i itself left out
///
/// `count` values as rows of `row` cells; N/2 neighbours on either side, more on the other side where the row ends. The
/// result has mean N/(N-1) on exponential noise, not 1, and a heavier tail; a target raises its neighbours' reference.
/// See correctAveraged. Preconditions: 1 ≤ N < row. A row without any power stays 0. Source: the usual cell average;
/// Grossi and Lops 2006 name no details.
void averageCells(std::span<float> y, Index row, Index N);

/// Turns cells that averageCells has been through into those of the same evidence for a target of the given SNR where
/// noise is known:
///
///   y = (N+1)/s · ln [ (1 + t/N) / (1 + t/(N(1+ρ))) ],   s = ρ/(1+ρ)
///
/// t = y(i)/mean of N is distributed as (1 + t/N)^{-N} on noise, as (1 + t/(N(1+ρ)))^{-N} with a target, so that the
/// exponential likelihood ratio of this y is the exact one of t. Without it the heavy tail of t passes for targets: on
/// noise E e^λ is infinite.
void correctAveraged(std::span<float> t, Index N, double snr);

} // namespace faintline
