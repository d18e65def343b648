#pragma once

#include "analysis/AnalysisSettings.h"

#include <string>
#include <vector>

namespace faintline {

/// A window that was tried on a recording (chooseWindow.h).
struct WindowTrial {
    AnalysisSettings settings; ///< with that window, and the law of motion that goes with it
    double windowSeconds = 0.0;
    std::ptrdiff_t tracks = 0;
    /// Share of the energy along its tracks that the next longer window tried followed too (energyKept); NaN: not
    /// compared.
    double kept = 0.0;
};

/// What was asked for where the window was left to the recording, and what came of it.
struct WindowChoice {
    AnalysisSettings asked;
    std::vector<WindowTrial> trials; ///< by window, the shortest first
    std::size_t automatic = 0;       ///< the one that comes of the recording's length and rate alone
    std::size_t chosen = 0;
    std::ptrdiff_t steadyLines = 0; ///< found with the one after it (steadyLines.h)
};

/// Why that window: "window 0.005 s chosen; one of 0.02 s would follow 11 % of the energy along its tracks; 3 steady
/// lines found with a window of 0.02 s".
std::string windowChoiceWords(const WindowChoice &choice);

} // namespace faintline
