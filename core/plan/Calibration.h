#pragma once

#include "noise/NoiseBackground.h"
#include "plan/AnalysisSettings.h"
#include "plan/RareRates.h"

#include <vector>

namespace faintline {

/// Response of a detector to noise alone, measured by sending simulated noise through the same chain.
///
/// An event is anything from which the whole chain starts a track, with clustering, reset and inhibition, on frames
/// with an estimated background. Its rate combines two measurements:
///
///   ln rate(T) = ln S(T) + δ(T)
///
/// S: excursions of the statistic on noise of known level, followed by multilevel splitting (`RareRates`) as far as
/// needed; a straight line is not used, because near the 50 % rule the tail is curved. δ: ratio of the chain's count to
/// S at three thresholds, two where events crowd each other out (some 2500 and 600, in a tenth of the noise) and one where
/// they do not (some 400); linear between them, constant beyond. Above the last one S gives the shape and the count the
/// height. Oracle: brute force over 200 hours (docs/performance.md).
///
/// Detectors that decide at the ends of blocks have S from blocks under tilted laws (`measureBlockRates`). Without S
/// (several axes, short windows such as that of P out of N), ln(rate) = ln(eventRate) - θ(T - u), fitted by maximum
/// likelihood to the Poisson counts at two thresholds far apart. The error of the background is not added: a chance
/// excursion raises its own background, and adding the error gave thresholds for twice as many events as occurred.
struct Calibration {
    bool isFirstEstimate = false; ///< made quickly, to be refined
    /// ln K in force; for other detectors, that of the sequential Markov detector that guides their tracks.
    double lnK = 0.0;
    double continuedFraction = 0.0; ///< measured, over all states
    double anchorNats = 0.0;        ///< u
    double eventRate = 0.0;         ///< events per cell and frame at threshold u
    double tailSlope = 1.0;         ///< θ, 1/nat; for a tail from splitting, that of its last part
    RareRates rates;                ///< events per cell and frame at given thresholds, from splitting; may be empty
    RareRates excursions;           ///< S, from which they were derived; empty if there are none or in a narrow band
    double relativeError = 0.0;     ///< standard error of ln(event rate) at u
    double slopeError = 0.0;        ///< standard error of θ
    double lowestLevel = 0.0;       ///< nat, of equidistant levels
    double levelStep = 1.0;         ///< nat
    double cells = 1.0;             ///< simulated
    std::vector<double> above;      ///< number of these with D > level, for each level

    std::size_t levelCount() const { return above.size(); }
    double level(std::size_t number) const { return lowestLevel + levelStep * double(number); }
    /// P(D > level) of a cell, simulated.
    double exceedance(std::size_t number) const { return above[number] / cells; }

    /// Events per cell and frame on noise at a threshold.
    double eventRateAt(double nats) const;
    /// P(D > T) of a cell, interpolated in the simulated curve and extrapolated with θ.
    double exceedanceAt(double nats) const;
    double thresholdForEventRate(double eventsPerCellFrame) const;
    double thresholdForPfa(double probability) const;
    /// 95 % confidence factor of the rate, in either direction.
    double rateUncertaintyAt(double nats) const;
    /// The lowest simulated level that a cell exceeds with at most this probability, never extrapolated; available
    /// while events are still being counted. -∞ if nothing was simulated.
    double levelExceededBy(double probability) const;
    /// 95 % half width, in nats, of the threshold for an event rate.
    double thresholdUncertainty(double eventsPerCellFrame) const;

    bool operator==(const Calibration &) const = default;
};

/// The threshold in nats that the decide settings specify.
double thresholdNats(const DecideSettings &decide, const Calibration &calibration, double cellFramesPerHour);

/// Cells × frames per hour of these frames, without the stop bands, which are not searched.
double cellFramesInAnHour(const AnalysisSettings &settings, const Spectrogram &spectrogram);

/// The stop bands, unless a causal background, which does not know them, searches them.
std::vector<StopBand> bandsNotSearched(const AnalysisSettings &settings, const Spectrogram &spectrogram);

/// The reset rule that the settings specify, with the ln K found.
ResetRule resetRule(const SmdSettings &settings, double lnK);

/// k_t and k_f of a spectrogram, for detectors specified in windows and cells.
FrameGeometry frameGeometry(const SpectrogramSettings &settings);

} // namespace faintline
