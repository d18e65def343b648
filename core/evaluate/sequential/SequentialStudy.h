#pragma once

#include "detect/Sprt.h"

#include <cstdint>
#include <optional>

namespace faintline {

/// Simulation of a sequential test under conditions that may differ from its design.
///
/// Cells are exponential: mean 1 without the target, 1 + actualSnr with it (Grossi and Lops 2006, eq. 10); the target's
/// start and moves follow the model's law. λ is given by the model's likelihood, exponential with the design SNR.
struct SequentialStudy {
    SequentialModel model;
    SprtSettings sprt;
    std::optional<double> actualSnr; ///< power ratio; nothing: noise only
    Index trials = 1000;
    std::uint64_t seed = 1;
    Index averagedCells = 0;          ///< N of averageCells along the model's last axis; 0: known noise power
    bool estimatesTrajectory = false; ///< if H1 is accepted
    Index lastWithinCells = 2;        ///< P_c,last: largest error at the stopping stage that counts as correct
    Index trackWithinCells = 5;       ///< P_c,track: the same over all stages
};

} // namespace faintline
