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
/// by simulated noise. Parts of lines that were missed raise the fraction in many cells around, because paths branch off
/// them. Therefore the fraction is counted in tiles of 16 cells and 50 frames, and p is the lower quartile of the tiles,
/// which a wrong level moves as much as their mean, but lines hardly: of the recording's, and of simulated white noise.
/// Tiles whose statistic exceeds what noise exceeds in one of 10 000 cells and frames are left out of both.
/// (For families and several channels, p is the mean, and the calibration's.) The band is
///
///   p ± (5 σ + 0.01 + 1/cells),   σ² = 16·p(1 - p)/(cells·frames)
///
/// A sixteenth of the cells and frames counts as independent, because windows and bins overlap, and paths last; a
/// quantile and its reference scatter more than a mean. One per cent is the normaliser's own error, which the calibrated
/// threshold includes; 1/cells is the loss at the ends of a band. Oracle: a hundred recordings of white noise without a
/// warning.
struct NoiseLawCheck {
    double expected = 0.0; ///< p on white noise
    double found = 0.0;    ///< p of the recording's noise outside tracks
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
