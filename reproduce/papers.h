#pragma once

#include "reproduce/Reproduction.h"

#include <vector>

namespace faintline {

/// Tables 1 to 3 and Figure 1 of Billon 2005, with references from an independent program.
std::vector<Reproducible> billonReproducibles();

// Figures 2 to 4 of Grossi and Lops 2006: stages against knowledge of the trajectory, correct trajectories, and the
// radar case. The publication's figures give no numbers; references are exact or come from an independent program,
// with their standard errors.

Reproducible grossiStages();       ///< Figure 2
Reproducible grossiTrajectories(); ///< Figure 3
Reproducible grossiRadar();        ///< Figure 4

// Figures 1 to 5 and Table 2 of Parsons 2008, with references from an independent program or a closed form.

std::vector<Reproducible> parsonsChain();       ///< Figure 1
std::vector<Reproducible> parsonsFalseAlarms(); ///< Figures 2 and 3
std::vector<Reproducible> parsonsDetection();   ///< Figures 4 and 5
Reproducible parsonsTable2();

} // namespace faintline
