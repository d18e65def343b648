#pragma once

#include "detect/inspectStages.h"
#include "evaluate/sequential/ScanTest.h"

#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// Results of a radar's sequential tests as CSV text with a header. Stages, rounds and sectors count from 1, cells from
/// 0.

/// "hypothesis,run,stage,lnLambda,decision", one row per stage taken; decision on the last row of a run. `isSimulated`:
/// the hypothesis is known.
std::string walksCsv(const std::vector<std::pair<ScanRun, SprtResult>> &walks, bool isSimulated);

/// "stage,cell,probability", one row per cell and stored stage.
std::string posteriorCsv(const PosteriorPicture &posterior);

/// "round,sector,target,first_stage,stages,decision", one row per look.
std::string sectorsCsv(const ScanTest &test, const SectorRounds &rounds);

} // namespace faintline
