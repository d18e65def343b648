#pragma once

#include "reproduce/Reproduction.h"

#include <vector>

namespace faintline {

/// Figures 1 to 5 and Table 2 of Parsons 2008, with references from an independent program or a closed form.
std::vector<Reproducible> parsonsReproducibles();

} // namespace faintline
