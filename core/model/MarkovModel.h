#pragma once

#include "model/Likelihood.h"
#include "model/StateSpace.h"

#include <string>

namespace faintline {

/// Model of a track-before-detect recursion: how a state moves, and how a signal changes a cell.
struct MarkovModel {
    StateSpace space;
    Likelihood likelihood;
    /// Multiplies ln P by (1+ρ)/ρ, which makes the linear likelihood an exact rescaling of the exponential one
    /// (Parsons 2008, eq. 10 from eq. 8).
    double transitionScale = 1.0;
};

} // namespace faintline
