#pragma once

#include "analysis/Analysis.h"
#include "track/PathStrip.h"

#include <span>
#include <string_view>

namespace faintline {

/// Fills in strips of an analysis' frames, which know where they lie: y as the detector sees it, 0 where it is blind.
/// One pass over the frames from the first strip to the last, in any order and number. Throws Cancelled. `what`: is
/// being done, for the progress.
void readStrips(const Analysis &analysis, std::vector<PathStrip *> strips, const RunContext &context,
                std::string_view what);

} // namespace faintline
