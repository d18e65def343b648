#pragma once

#include "frames/PeakPyramid.h"
#include "plan/Calibration.h"
#include "scene/Fluctuation.h"

#include <vector>

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

// Detection probabilities of fluctuating targets in closed form. Noise cells are exponential of mean 1, looks are
// independent, and a target of relative power g adds a constant amplitude of power g·snr in a look; g has mean 1.

/// P( mean of `looks` cells > threshold ) of a target with mean SNR `snr` (a power ratio), V = looks·threshold.
///
///   none        Marcum's Q (theory.h)
///   swerling1   Σ = Γ(N-1) + (1 + N·snr)·Γ(1):  Q(N-1, V) + A(N-1),  a = 1 + N·snr
///   swerling2   Σ = (1 + snr)·Γ(N):             Q(N, V/(1 + snr))
///   swerling3   Σ = Γ(N-2) + a·Γ(2):            Q(N-2, V) + (1 + V/a)·A(N-2) - (N-2)/a·A(N-1),  a = 1 + N·snr/2
///   swerling4   Σ = a·Γ(N + B):                 E Q(N + B, V/a),  B binomial of N and 1 - 1/a,  a = 1 + snr/2
///
/// with Γ(n) a gamma variable of shape n, Q its upper tail, and A(n) = ∫₀ⱽ f_n(x) e^{-(V-x)/a} dx over its density f_n.
/// One look: e^{-V/a} (1, 2) and e^{-V/a}·(1 + (a - 1)V/a²) (3, 4). Sources: Swerling 1954; Meyer and Mayer 1973; the
/// forms are exact. Oracles: the mixture of Poisson and negative binomial laws; simulation.
double pdOfMeanPower(double threshold, int looks, double snr, Fluctuation fluctuation);

/// P( at least p of n independent frames have an event ), an event being a cell that exceeds `threshold`.
///
/// A binomial tail without fluctuation and where each frame has its own power (Swerling 2 and 4). With one power for
/// all frames (1 and 3), the mean of the binomial tail over that power, by quadrature to 1e-9. Oracle: simulation.
double pdOfPofN(int p, int n, double threshold, double snr, Fluctuation fluctuation);

/// One point of an exceedance curve.
struct ExceedancePoint {
    double level = 0.0; ///< nat, or multiples of the noise
    double probability = 0.0;
};

/// P(D > T) of a noise cell where it is known in closed form, from the lowest T worth drawing to where it falls below
/// 10⁻¹⁵; empty otherwise.
///
///   energy       e^{-T}                                       for any overlap: one cell's law
///   integrator   gamma law of n looks (pfaOfMeanPower)        of a boxcar of n windows without overlap in time
///   SMD          σ e^{-(1-σ)(T + ln K)} (lindleyExceedance)   one slope kept, linear likelihood, no overlap in time,
///                                                             ln K < -1 fixed: D is Lindley's L before ln K is added,
///                                                             T ≥ -ln K
///
/// Adjacent bins may overlap: the law is that of one cell. The error of the estimated noise background is ignored.
std::vector<ExceedancePoint> closedFormExceedance(const AnalysisSettings &settings, const Calibration &calibration);

/// Fraction of cells in a box of a statistic's picture whose D exceeds a level, for each level of the picture's scale
/// (a quarter of a unit) down to the last level that ten cells exceed; this is the behaviour of noise in this recording
/// if the box holds nothing else. Frames begin … end-1 and cells begin … end-1 of the last axis. Examines at most 2·10⁶
/// cells, in evenly spread rows. Empty for an empty box, and if frames have been merged, because the picture then holds
/// maxima.
std::vector<ExceedancePoint> boxExceedance(const PeakPyramid &statistic, Index beginFrame, Index endFrame,
                                           Index beginCell, Index endCell);

} // namespace faintline
