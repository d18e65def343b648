#pragma once

#include "detect/inspectStages.h"
#include "evaluate/sequential/ScanTest.h"

#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// What a radar's sequential tests showed, as CSV text with a header; stages, rounds and sectors count from 1, cells
/// from 0.

/// "hypothesis,run,stage,lnLambda,decision", a row per stage taken; decision on the last of a run. `isSimulated`: the
/// hypothesis is known.
std::string walksCsv(const std::vector<std::pair<ScanRun, SprtResult>> &walks, bool isSimulated);

/// "stage,cell,probability", a row per cell and kept stage.
std::string posteriorCsv(const PosteriorPicture &posterior);

/// "round,sector,target,first_stage,stages,decision", a row per look.
std::string surveyCsv(const ScanTest &test, const Survey &survey);

} // namespace faintline
