#pragma once

#include "evaluate/comparison/compareAnalyses.h"

#include <string>

namespace faintline {

/// Writes the signals detected by two analyses, .csv: in (A, B or both), event_a, event_b (their numbers), t_onset,
/// t_end, f (or a column per axis), drift_hz_per_s (B's if B has it), t_detect_a, t_detect_b, statistic_a, statistic_b,
/// shared_s. Missing values are empty. Numbers are in the C locale, in the shortest form that reads back the same. The
/// file appears when it is complete. Throws Error.
void writeComparison(const Comparison &comparison, const Grid &grid, const std::string &path);

/// Throws Error if `writeComparison` does not know the extension of a name; call it before a long run.
void checkComparisonPath(const std::string &path);

/// Writes the difference layer, .npy: float32, shape (rows, cells), nat.
void writeDifference(const PeakPyramid &difference, const std::string &path);

} // namespace faintline
