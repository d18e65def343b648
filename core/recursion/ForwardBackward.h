#pragma once

#include "base/RunContext.h"
#include "model/StateSpace.h"

#include <span>
#include <vector>

namespace faintline {

/// Posterior of a present target's state, given all frames.
struct Posterior {
    std::vector<double> probability; ///< γ: frames × states, StateSpace order; each frame adds up to 1
    double lnEvidence = 0.0;         ///< ln of the sum over all paths
};

/// Forward and backward over a whole state space:
///
///   α_1(n) = P_1(n) e^{λ_1(n)},   α_t(n) = e^{λ_t(n)} Σ_m P(n|m) α_{t-1}(m)
///   β_T(n) = 1,                   β_{t-1}(m) = Σ_n P(n|m) e^{λ_t(n)} β_t(n)
///   γ_t(n) = α_t(n) β_t(n) / Σ,   lnEvidence = ln Σ_n α_T(n)
///
/// `initial`: P_1 of each state, empty for 1/states; `lambda`: λ of frames × cells, finite or -∞; the step into frame t
/// is step number t. The law is not renormalised: probability that leaves the axes is lost. Computed in logarithms, so
/// that evidence of any size neither overflows nor removes a path that later frames prefer. `presenceIn` (track) is the
/// same along a corridor, with a state "off". Source: Baum and others 1970; Rabiner 1989. Oracle: enumeration of all
/// paths. Cost: two exponentials per state, move and frame. Memory: the result and the moves of each phase. Throws
/// Error if no path has a positive probability or there are more than 2²⁷ moves; Cancelled.
Posterior forwardBackward(const StateSpace &space, std::span<const double> initial, std::span<const double> lambda,
                          const RunContext &context = {});

} // namespace faintline
