#pragma once

#include "model/Likelihood.h"

#include <cstddef>
#include <vector>

namespace faintline {

/// What a law h(0), h(1), … of rate changes means for a signal that is integrated along its path.
///
/// In each step a path gains λ + ln P + ln K (Smd). It grows out of the noise as long as it gains on the mean,
///
///   E[λ | SNR] + ln P + ln K > 0,
///
/// so the lowest SNR that still integrates is where this is 0: below it a path is reset over and over. Of a signal that
/// keeps its rate P = h(0). Other paths near by help a little, which is left out. Oracles: closed forms of the
/// exponential law, simulation.

/// The law with h(change) set to a probability, held within what a law allows; the others keep their proportions, h(0)
/// + 2 Σ h(i) = 1. Where the others were 0, h(0) takes what is left over, or h(1) if it is h(0) that is set. Zeros at
/// the end are dropped.
std::vector<double> withProbability(std::vector<double> law, std::size_t change, double probability);

/// -ln of the largest and of the smallest probability that is not 0, and its mean Σ h (-ln h) over the law's own
/// changes, nat per step.
struct LawDamping {
    double likeliest = 0.0;
    double unlikeliest = 0.0;
    double mean = 0.0;
};
LawDamping damping(const std::vector<double> &law);

/// E[λ | SNR] in one frame, of a signal as the likelihood takes it to be (constant amplitude, fluctuating), whatever
/// SNR that was designed for.
double meanEvidence(const Likelihood &likelihood, double snr);

/// The SNR, a power ratio in one frame, at which the mean evidence makes up for `lossNats` = -(ln P + ln K); 0 where
/// even noise does.
double lowestIntegratedSnr(const Likelihood &likelihood, double lossNats);

} // namespace faintline
