#pragma once

#include "base/Axis.h"

#include <span>

namespace faintline {

/// Divides each cell by the mean of its neighbours, for noise of unknown power (cell-averaging CFAR).
///
///   y(i) ← y(i) / [ 1/N Σ y(j) ],   j: the N cells nearest to i on its row, i itself left out
///
/// `count` values as rows of `row` cells, with N/2 neighbours on either side, more on the other side at the end of a
/// row. On exponential noise the result has mean N/(N-1), not 1, and a heavier tail; a target raises its neighbours'
/// reference. See correctAveraged. Preconditions: 1 ≤ N < row. A row without power stays 0. Source: the usual cell
/// average; Grossi and Lops 2006 give no details.
void averageCells(std::span<float> y, Index row, Index N);

/// Transforms the output of averageCells to cells that give the same evidence for a target of the given SNR as if the
/// noise were known:
///
///   y = (N+1)/s · ln [ (1 + t/N) / (1 + t/(N(1+ρ))) ],   s = ρ/(1+ρ)
///
/// t = y(i)/mean of N is distributed as (1 + t/N)^{-N} on noise and as (1 + t/(N(1+ρ)))^{-N} with a target, so that the
/// exponential likelihood ratio of this y is the exact one of t. Without the transform, the heavy tail of t is taken
/// for targets: on noise E e^λ is infinite.
void correctAveraged(std::span<float> t, Index N, double snr);

} // namespace faintline
