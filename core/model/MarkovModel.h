#pragma once

#include "model/Likelihood.h"
#include "model/StateSpace.h"

#include <string>

namespace faintline {

/// What a track-before-detect recursion is told of the world: how a state moves, and what a signal does to a cell.
struct MarkovModel {
    StateSpace space;
    Likelihood likelihood;
    /// Multiplies ln P by (1+ρ)/ρ, which makes the linear likelihood an exact rescaling of the exponential one
    /// (Parsons 2008, eq. 10 from eq. 8).
    double transitionScale = 1.0;
};

} // namespace faintline
