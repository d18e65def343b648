#pragma once

#include "model/Likelihood.h"

#include <cstddef>
#include <vector>

namespace faintline {

/// What a law h(0), h(1), … of rate changes means for a signal that is integrated along its path.
///
/// In each step a path gains λ + ln P + ln K (Smd). It rises out of the noise as long as its mean gain is positive,
///
///   E[λ | SNR] + ln P + ln K > 0,
///
/// so the lowest SNR that still integrates is where this is 0; below it the path is reset repeatedly. For a signal that
/// keeps its rate, P = h(0). The small contribution of neighbouring paths is neglected. Oracles: closed forms of the
/// exponential law, simulation.

/// The law with h(change) set to a probability, limited to what a law allows; the others keep their proportions, with
/// h(0) + 2 Σ h(i) = 1. If the others were 0, h(0) takes the remainder, or h(1) if h(0) is set. Trailing zeros are
/// removed.
std::vector<double> withProbability(std::vector<double> law, std::size_t change, double probability);

/// -ln of the largest and of the smallest non-zero probability, and the mean Σ h (-ln h) over the law's own changes,
/// nat per step.
struct LawDamping {
    double likeliest = 0.0;
    double unlikeliest = 0.0;
    double mean = 0.0;
};
LawDamping damping(const std::vector<double> &law);

/// E[λ | SNR] in one frame of a signal of the likelihood's kind (constant amplitude, fluctuating), at any SNR, not only
/// the design SNR.
double meanEvidence(const Likelihood &likelihood, double snr);

/// The SNR, a power ratio in one frame, at which the mean evidence compensates `lossNats` = -(ln P + ln K); 0 if noise
/// alone does.
double lowestIntegratedSnr(const Likelihood &likelihood, double lossNats);

} // namespace faintline
