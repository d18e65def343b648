#pragma once

#include "analysis/Analysis.h"

namespace faintline::cli {

/// Prints what an analysis was made with and what it found: frames, window, threshold, warnings and advice, events,
/// areas. For people; the columns of files are writeEvents.h's.
void printSummary(const Analysis &analysis);

} // namespace faintline::cli
