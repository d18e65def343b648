#pragma once

#include "plan/Analysis.h"

#include <string>
#include <vector>

namespace faintline::cli {

/// Prints a summary of an analysis for people: frames, window, threshold, warnings, notes on the recording, advice,
/// events, areas. For the columns of files see writeEvents.h.
void printSummary(const Analysis &analysis, const std::vector<std::string> &notes);

/// A time and a position of an event for people, with as many digits as its frame and its cell need.
std::string secondsOf(double seconds, const Axis &time);
std::string positionText(double position, const Axis &axis);

} // namespace faintline::cli
