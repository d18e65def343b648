#pragma once

namespace faintline {

// Closed forms for detectors. Noise cells are exponential of mean 1, signals of constant amplitude add power `snr` (a
// ratio), looks are independent.

/// P( mean of `looks` noise cells > threshold ): a gamma law.
double pfaOfMeanPower(double threshold, int looks);

/// The threshold for that probability.
double thresholdOfMeanPower(double pfa, int looks);

/// P( mean of `looks` cells > threshold ) with a signal: Marcum's Q of order `looks`, a non-central χ² law of 2·looks
/// degrees of freedom. Billon 2005 section 5: "the well-known ROC curves for the Rice case".
double pdOfMeanPower(double threshold, int looks, double snr);

/// The same two for a threshold of `threshold` times the mean of `references` other noise cells (cell averaging):
/// Fisher's F law, central and non-central.
double pfaOfMeanPowerEstimated(double threshold, int looks, int references);
double pdOfMeanPowerEstimated(double threshold, int looks, int references, double snr);

/// The SNR at which the mean of `looks` cells is detected with probability pd at false-alarm probability pfa.
double snrOfMeanPower(double pd, double pfa, int looks);

/// P( at least p of n independent frames have an event ), each with probability `event`: a binomial tail.
double pdOfPofN(int p, int n, double event);

/// Lindley's recursion in closed form: the sequential Markov detector with one-to-one transitions and the linear
/// likelihood, on noise,
///
///   L ← max(L, 0) + y + ln K,   σ the root below 1 of σ = exp(ln K·(1-σ)),   P(L > T) = σ·e^{-(1-σ)T} for T ≥ 0
///
/// for ln K < -1. The probability of a reset is 1 - σ. Oracle: 2·10⁸ simulated steps.
double lindleySigma(double lnK);
double lindleyExceedance(double threshold, double lnK);

} // namespace faintline
