#pragma once

#include "base/RunContext.h"
#include "model/Likelihood.h"
#include "recursion/PathStrip.h"

#include <array>
#include <vector>

namespace faintline {

/// The most probable pair of paths of two signals of similar power that remain within a strip.
///
/// Two paths that are searched one after the other, or each alone, change from one signal to the other whenever the sum
/// of the other's evidence exceeds the price of the change. Here the pair (p, r, q, s) of two positions and two rates
/// is one state of a Viterbi recursion, without reset,
///
///   u_t(p, r, q, s) = E_t(p, q)
///                     + max over r', s' of [u_(t-1)(p - d(r), r', q - d(s), s') + ln h(|r-r'|) + ln h(|s-s'|)]
///   E_t(p, q) = λ(y_t(p)) + λ(y_t(q)) if |p - q| ≥ `apart` cells, max(λ(y_t(p)), λ(y_t(q))) otherwise
///
/// so that no cell is evidence for both. Rates are relative to the strip's centres, in eighths of a cell up to half a
/// cell per frame, with Bresenham displacements d (KinematicAxis) and h = (0.9, 0.05). With ±6 cells that is 13 689
/// states.
///
/// Returns the cells of both paths, one per frame of the strip. NaN is no evidence. Long strips are decided in blocks
/// of 512 frames with 128 frames of the next block, so that memory is bounded. Throws Cancelled.
std::array<std::vector<Index>, 2> jointPaths(PathStrip strip, const Likelihood &likelihood, Index apart,
                                             const RunContext &context = {});

} // namespace faintline
