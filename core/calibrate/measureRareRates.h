#pragma once

#include "base/RunContext.h"
#include "detect/Detector.h"
#include "noise/noiseStreams.h"
#include "plan/RareRates.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace faintline {

struct SplittingSettings {
    int entries = 1000;         ///< trials per level, over all runs
    int pilots = 200;           ///< trials of each run that determine the next level
    double leastLnRate = -25.0; ///< levels continue until cycles are as rare as this, per cell and frame
    std::uint64_t seed = 3000;
};

/// Calls `makeDetector` and `makeNoise` once per thread. Results do not depend on the number of threads. Empty if the
/// detector cannot save its state, if the state is too large, or if all trials soon descend from a few large cells, as
/// with short windows (P out of N): the scatter of the runs then exceeds a half before rates are rare.
RareRates measureRareRates(const std::function<std::unique_ptr<Detector>()> &makeDetector,
                           const std::function<std::unique_ptr<NoiseStream>()> &makeNoise,
                           const SplittingSettings &settings, const RunContext &context = {});

/// Rates of rare statistics of a detector that decides at the ends of blocks, per cell and frame.
///
/// Let V_t be the largest score in frame t of a block on a small band of `cells` cells. If P(V_B > T) is small for
/// blocks of B frames, so is the rate of events:
///
///   rate(T) = -ln(1 - P(V_B > T)) / (cells·B)
///
/// Blocks have no past, so they cannot be restarted from level to level as in `measureRareRates`. Instead, many blocks
/// of noise run in parallel from their first frame to their last, weighted by e^(α(V_t - V_(t-1))) in every frame, and
/// are resampled when the weights have become unequal. The blocks at the end are noise under the tilted law e^(αV_B)/Z,
/// with Z the product of the mean weights. Runs with increasing α, each by one standard deviation of V_B, reach further
/// and further into the tail; together they give the probability of every level (balance heuristic):
///
///   P(V_B > T) = Σ_k Σ_i ω_ki 1(V_ki > T) / Σ_j e^(α_j V_ki)/Z_j,   ω_ki the final weights of run k, Σ_i ω_ki = 1
///
/// Errors are those of independent repetitions. Source: Del Moral and Garnier 2005, Genealogical particle analysis of
/// rare events; Veach and Guibas 1995. Oracle: a sum of exponentials is a gamma variable
/// (tests/calibrate/tst_blockRates).
///
/// `makeDetector` makes the detector that runs from a block's first frame on; it must be able to save its state. The
/// result is empty if it cannot, or if the relative errors exceed ½ before rates are rare. Cost: some 10⁶ frames of the
/// small band.
RareRates measureBlockRates(const std::function<std::unique_ptr<Detector>()> &makeDetector,
                            const std::function<std::unique_ptr<NoiseStream>()> &makeNoise, Index framesPerBlock,
                            const SplittingSettings &settings, const RunContext &context = {});

} // namespace faintline
