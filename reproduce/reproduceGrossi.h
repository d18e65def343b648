#pragma once

#include "reproduce/Reproduction.h"

#include <vector>

namespace faintline {

/// Figures 2 to 4 of Grossi and Lops 2006: stages against knowledge of the trajectory, correct trajectories, and the
/// radar case. The publication's figures give no numbers; references are exact or come from an independent program,
/// with their standard errors.
std::vector<Reproducible> grossiReproducibles();

} // namespace faintline
