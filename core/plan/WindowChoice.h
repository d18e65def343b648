#pragma once

#include "plan/AnalysisSettings.h"

#include <string>
#include <vector>

namespace faintline {

/// A window that was tried on a recording (chooseWindow.h).
struct WindowTrial {
    AnalysisSettings settings; ///< with that window and its law of motion
    double windowSeconds = 0.0;
    std::ptrdiff_t tracks = 0;
    /// Fraction of the energy along its tracks that the next longer window also followed (energyKept); NaN: not
    /// compared.
    double kept = 0.0;
};

/// Requested settings and result where the recording determined the window.
struct WindowChoice {
    AnalysisSettings asked;
    std::vector<WindowTrial> trials; ///< in order of window length, the shortest first
    std::size_t automatic = 0;       ///< the window determined by the recording's length and rate alone
    std::size_t chosen = 0;
    std::ptrdiff_t fromOthers = 0; ///< tracks that other trials know better (otherWindows.h)
};

/// Explains the choice: "window 0.005 s chosen; one of 0.02 s would follow 11 % of the energy along its tracks; 3
/// signals from other windows".
std::string windowChoiceWords(const WindowChoice &choice);

} // namespace faintline
