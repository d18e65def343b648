#pragma once

#include "base/Interval.h"
#include "base/RunContext.h"
#include "plan/Analysis.h"

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
/// Tiles whose statistic exceeds what noise exceeds in one of 10 000 cells and frames are left out of both, and paths as
/// good as that are forgotten there, before they branch. The band is
///
///   p ± (4 σ + 0.01)
///
/// where σ is that of twelve blocks of the simulated noise: under laws that let paths branch freely, the fractions of all
/// cells rise and fall together. One per cent is the normaliser's own error, which the calibrated threshold includes. For
/// families and several channels, p is the mean, and the calibration's, σ² = 16·p(1 - p)/(cells·frames), and 1/cells is
/// added for the ends of the band. Oracle: a hundred recordings of white noise without a warning.
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
