#pragma once

#include "analysis/AnalysisSettings.h"
#include "analysis/rareRates.h"
#include "base/RunContext.h"
#include "spectrum/NormalisedFrames.h"

#include <memory>
#include <string>
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
/// S at two thresholds, one where events crowd each other out (some 800, in a tenth of the noise) and one where they do
/// not (some 400); linear between them, constant beyond. Above the second one S gives the shape and the count the
/// height. Oracle: brute force over 200 hours (README of the core).
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
    double relativeError = 0.0;     ///< standard error of ln(event rate) at u
    double slopeError = 0.0;        ///< standard error of θ
    std::vector<double> levels;     ///< nats, ascending
    std::vector<double> exceedance; ///< P(D > level) of a cell, simulated

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

/// Depth of a calibration. A first estimate has the same ln K and P(D > level), and rates from a fifth of the noise and
/// shorter splitting: accurate to a factor of about 1.5, after 2 s instead of 7. If that accuracy is not possible (no
/// score of paths, no splitting), the result is a refined one.
enum class CalibrationDepth { FirstEstimate, Refined };

/// Simulates white noise through spectrogram, normaliser and detector and measures the response. Depends only on the
/// dimensionless part of the settings (windows, overlaps, model, detector). This part is also the key under which
/// results are cached, for the life of the program and in the `CalibrationStore`.
std::shared_ptr<const Calibration> calibrate(const AnalysisSettings &settings, const RunContext &context = {},
                                             CalibrationDepth depth = CalibrationDepth::Refined);

/// The same for a band of `bins` bins on one axis: paths leave it at its ends, and in a narrow band few of them last.
///
///   ln rate(T) = ln rate_wide(T) + ln S_band(T) - ln S_wide(T),   S: excursions per cell and frame, each by splitting
///
/// From 64 bins on (of bands of 256 bins or more with slopes of four bins, from 128 on) the loss at the ends falls as
/// 1/bins. From 256 times the steepest slope on, and for lines that stay in their bin and detectors without splitting,
/// the wide band's calibration is used.
std::shared_ptr<const Calibration> calibrateBand(const AnalysisSettings &settings, Index bins,
                                                 const RunContext &context = {},
                                                 CalibrationDepth depth = CalibrationDepth::Refined);

/// The same for the frames of a spectrogram, or of a family over it, with the spectrogram's actual window.
std::shared_ptr<const Calibration> calibrateBand(AnalysisSettings settings, const Spectrogram &spectrogram,
                                                 const RunContext &context = {},
                                                 CalibrationDepth depth = CalibrationDepth::Refined);

/// Cells × frames per hour of these frames.
double cellFramesInAnHour(const FamilySettings &family, const Spectrogram &spectrogram);

/// The model on a part of its grid that is large enough to measure its response to noise: above 20 000 cells, the
/// longest bounded axis is cut to about 5000 cells in total and made cyclic, so that no path leaves the part. A sonar's
/// bounded range axis loses such paths, hence its false alarms are 13 to 40 % fewer than predicted here.
MarkovModel calibrationSubgrid(const MarkovModel &model);

/// The same for ready-made frames: independent exponential cells on a grid of the model's shape, or on its
/// calibrationSubgrid.
std::shared_ptr<const Calibration> calibrateOnIndependentCells(const MarkovModel &model,
                                                               const AnalysisSettings &settings,
                                                               const RunContext &context = {}, double cellFrames = 4e7);

/// The threshold in nats that the decide settings specify.
double thresholdNats(const DecideSettings &decide, const Calibration &calibration, double cellFramesPerHour);

/// ln K in force, and the fraction of all states that continue with it.
struct ResetFit {
    double lnK = 0.0;
    double continuedFraction = 0.0;
};

/// Determines ln K on noise fields, after the first 300 frames of each: by bisection for half of the states continued
/// if the settings specify that, or measures the effect of the given law. Cost: about fifteen passes over the fields.
ResetFit fitReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model, const SmdSettings &smd);

/// The reset rule that the settings specify, with the ln K found.
ResetRule resetRule(const SmdSettings &settings, double lnK);

/// k_t and k_f of a spectrogram, for detectors specified in windows and cells.
FrameGeometry frameGeometry(const SpectrogramSettings &settings);

} // namespace faintline
