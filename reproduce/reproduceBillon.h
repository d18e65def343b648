#pragma once

#include "reproduce/Reproduction.h"

#include <vector>

namespace faintline {

/// Tables 1 to 3 and Figure 1 of Billon 2005, with references from an independent program.
std::vector<Reproducible> billonReproducibles();

} // namespace faintline
