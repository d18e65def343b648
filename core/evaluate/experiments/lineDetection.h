#pragma once

#include "plan/Analysis.h"
#include "scene/Truth.h"

#include <cstddef>

namespace faintline {

/// How an analysis found a known line. A track *detects* the line if half of its points while the line lasts lie on it,
/// within 1.5 resolution cells of the window that found it, or of the analysis' own if that is shorter.
struct LineDetection {
    /// By how much the largest statistic of the tracks that detect it exceeds the threshold, in the detector's unit,
    /// above 0; -∞ if it was missed.
    double margin;
    double latencySeconds;       ///< from its start to its detection; -∞ if it was missed
    std::ptrdiff_t tracksBeside; ///< number of tracks that never touch the line
};
LineDetection lineDetection(const Analysis &analysis, const TruthLine &line);

/// The margin of a statistic (statisticOf) that the analysis detected, as that of a LineDetection.
double marginOf(double statistic, const Analysis &analysis);

} // namespace faintline
