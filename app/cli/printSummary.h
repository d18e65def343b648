#pragma once

#include "analysis/Analysis.h"

namespace faintline::cli {

/// Prints a summary of an analysis for people: frames, window, threshold, warnings and advice, events, areas. For the
/// columns of files see writeEvents.h.
void printSummary(const Analysis &analysis);

} // namespace faintline::cli
