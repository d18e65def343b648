#pragma once

#include "analysis/analyse.h"
#include "base/Interval.h"

#include <optional>
#include <string>

namespace faintline {

/// Tests whether a recording's noise outside its tracks is the noise for which its threshold was calibrated.
///
/// On that noise a known fraction p of the states continues from frame to frame (half of them, at the usual K). Levels
/// that are wrong by a few per cent, spread signals and noise that is not Gaussian change the fraction before they
/// cause events. The detector's recursion is repeated on a few stretches of the frames; cells near tracks are replaced
/// by simulated noise, so that lines do not affect the count. The band is
///
///   p ± (4 σ + 0.01 + 1/cells),   σ² = 16·p(1 - p)/(cells·frames)
///
/// A sixteenth of the cells and frames counts as independent, because windows and bins overlap, and paths last
/// (recordings of white noise scatter half as much, except for one in a hundred, in which a path lasted long). One per
/// cent is the normaliser's own error, which the calibrated threshold includes; 1/cells is the loss at the ends of a
/// band. Oracle: a hundred recordings of white noise without a warning.
struct NoiseLawCheck {
    double expected = 0.0; ///< p
    double found = 0.0;    ///< fraction found in the states outside tracks
    Interval band;

    bool isFollowed() const { return band.contains(found); }
    /// If the law is not followed: whether to expect more false alarms than specified rather than fewer.
    bool isMore() const { return found > expected; }
    /// The consequence in one sentence; empty if the law is followed.
    std::string warning() const;
};

/// Nothing for ready-made frames, for detectors without a fixed K, and if there are too few frames to decide. Cost:
/// some four million cells and frames, independent of the recording's length. Throws Cancelled.
std::optional<NoiseLawCheck> checkNoiseLaw(const Analysis &analysis, const RunContext &context = {});

} // namespace faintline
