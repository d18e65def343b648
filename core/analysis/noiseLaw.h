#pragma once

#include "analysis/analyse.h"
#include "base/Interval.h"

#include <optional>
#include <string>

namespace faintline {

/// Whether a recording's noise outside its tracks is the noise that its threshold was calibrated for.
///
/// On that noise a known fraction p of the states continues from frame to frame (half of them, at the usual K). Levels
/// that are wrong by a few per cent, spread signals and noise that is not Gaussian move the fraction before they make
/// events. The detector's recursion goes through a few stretches of the frames once more; cells near tracks hold
/// simulated noise, so that what a line takes or leaves is not counted. The band is
///
///   p ± (4 σ + 0.01 + 1/cells),   σ² = 16·p(1 - p)/(cells·frames)
///
/// A sixteenth of the cells and frames is as good as independent: windows and bins overlap, and paths last (recordings
/// of white noise scatter half as much, but for one in a hundred, in which a path lasted long). One per cent is the
/// normaliser's own error, which the calibrated threshold bears; 1/cells what the ends of a band take away. Oracle: a
/// hundred recordings of white noise without a warning.
struct NoiseLawCheck {
    double expected = 0.0; ///< p
    double found = 0.0;    ///< of the states outside tracks
    Interval band;

    bool isFollowed() const { return band.contains(found); }
    /// Whether more false alarms than specified are to be expected where it is not followed, not fewer.
    bool isMore() const { return found > expected; }
    /// What to make of it, in one sentence; empty where the law is followed.
    std::string warning() const;
};

/// Nothing for ready-made frames, for detectors without a fixed K, and where there are too few frames to tell. Cost:
/// some four million cells and frames, independent of the recording's length. Throws Cancelled.
std::optional<NoiseLawCheck> checkNoiseLaw(const Analysis &analysis, const RunContext &context = {});

} // namespace faintline
