#pragma once

#include "analysis/Analysis.h"
#include "track/PathStrip.h"

#include <span>
#include <string_view>

namespace faintline {

/// Fills strips of an analysis's frames, whose positions are set, in any order and number, in one pass: y as the
/// detector takes it, 0 in excluded cells. `what`: activity shown with the progress. Throws Cancelled.
void readStrips(const Analysis &analysis, std::vector<PathStrip *> strips, const RunContext &context,
                std::string_view what);

} // namespace faintline
