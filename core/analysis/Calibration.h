#pragma once

#include "analysis/AnalysisSettings.h"
#include "analysis/rareRates.h"
#include "base/RunContext.h"
#include "spectrum/NormalisedFrames.h"

#include <memory>
#include <string>
#include <vector>

namespace faintline {

/// How a detector answers to noise alone: found by simulation, the same noise through the same chain.
///
/// An event is what the whole chain starts a track from, with its clustering, reset and inhibition, on frames whose
/// background was estimated. Its rate is known in two ways, put together:
///
///   ln rate(T) = ln S(T) + δ(T)
///
/// S: excursions of the statistic on noise of known level, followed by multilevel splitting (`RareRates`) as far as
/// they are asked for; never a straight line, for near the 50 % rule a tail is curved. δ: what the chain counts over S
/// at two thresholds, one where events crowd each other out (some 800, in a tenth of the noise) and one where they do
/// not (some 400): linear between them, constant beyond. Above the second one S alone gives the shape, the count the
/// height. Oracle: brute force over 200 hours (README of the core).
///
/// Where nothing is split (several axes, detectors that cannot tell their state, short windows such as P out of N's),
/// ln(rate) = ln(eventRate) - θ(T - u), fitted by maximum likelihood to the Poisson counts at two thresholds far apart.
/// The background's own error is not added: a chance excursion raises the background that it is divided by, and
/// reckoning that error in ordered twice as many as came.
struct Calibration {
    bool isFirstEstimate = false; ///< made quickly, to be refined
    /// ln K in force; for other detectors, of the sequential Markov detector that guides their tracks.
    double lnK = 0.0;
    double continuedFraction = 0.0; ///< realised, of all states
    double anchorNats = 0.0;        ///< u
    double eventRate = 0.0;         ///< events per cell and frame at threshold u
    double tailSlope = 1.0;         ///< θ, 1/nat; of a tail that was followed by splitting, its last part's
    RareRates rates;                ///< events per cell and frame at thresholds, followed by splitting; may be empty
    double relativeError = 0.0;     ///< standard error of ln(event rate) at u
    double slopeError = 0.0;        ///< standard error of θ
    std::vector<double> levels;     ///< nats, ascending
    std::vector<double> exceedance; ///< P(D > level) of a cell, simulated

    /// Events per cell and frame at a threshold, on noise.
    double eventRateAt(double nats) const;
    /// P(D > T) of a cell, interpolated in the simulated curve, continued with θ.
    double exceedanceAt(double nats) const;
    double thresholdForEventRate(double eventsPerCellFrame) const;
    double thresholdForPfa(double probability) const;
    /// The rate lies within this factor of what it is said to be, either way (95 %).
    double rateUncertaintyAt(double nats) const;
    /// The lowest simulated level that a cell exceeds with at most that probability, never continued: known while
    /// events are still being counted. -∞ where nothing was simulated.
    double levelExceededBy(double probability) const;
    /// 95 % half-width, in nats, of the threshold for an event rate.
    double thresholdUncertainty(double eventsPerCellFrame) const;

    bool operator==(const Calibration &) const = default;
};

/// How closely to calibrate. A first estimate has the same ln K and P(D > level), and rates from a fifth of the noise
/// and shorter splitting: to a factor of about 1.5, after 2 s instead of 7. Where that would not hold (no score of
/// paths, nothing split) the answer is refined.
enum class CalibrationDepth { FirstEstimate, Refined };

/// Simulates white noise through spectrogram, normaliser and detector and measures the answer. Depends on nothing but
/// the dimensionless part of the settings (windows, overlaps, model, detector), which is also the key under which
/// results are kept, for the life of the program and in the `CalibrationStore`.
std::shared_ptr<const Calibration> calibrate(const AnalysisSettings &settings, const RunContext &context = {},
                                             CalibrationDepth depth = CalibrationDepth::Refined);

/// The same for a band of `bins` bins on one axis: paths run off its ends, and in a narrow band few of them last.
///
///   ln rate(T) = ln rate_wide(T) + ln S_band(T) - ln S_wide(T),   S: excursions per cell and frame, each by splitting
///
/// From 64 bins on the ends do not see each other: 1 - S_band/S_wide falls as 1/bins; from 256 on it is the wide band's
/// calibration. So it is for lines that stay in their bin, and for detectors that are not followed by splitting.
std::shared_ptr<const Calibration> calibrateBand(const AnalysisSettings &settings, Index bins,
                                                 const RunContext &context = {},
                                                 CalibrationDepth depth = CalibrationDepth::Refined);

/// The same for the frames of a spectrogram, or of a family over it, with the window as the spectrogram has it.
std::shared_ptr<const Calibration> calibrateBand(AnalysisSettings settings, const Spectrogram &spectrogram,
                                                 const RunContext &context = {},
                                                 CalibrationDepth depth = CalibrationDepth::Refined);

/// Cells × frames of an hour of these.
double cellFramesInAnHour(const FamilySettings &family, const Spectrogram &spectrogram);

/// The model on a piece of its grid large enough to learn its answer to noise: where it has more than 20 000 cells, the
/// longest bounded axis is cut to about 5000 cells in all and made cyclic, so that no path runs off the piece. A
/// sonar's bounded range axis loses such paths, hence its false alarms come 13 to 40 % short of what is found here.
MarkovModel calibrationSubgrid(const MarkovModel &model);

/// The same for ready-made frames: independent exponential cells on a grid of the model's shape, or of its handy
/// piece's.
std::shared_ptr<const Calibration> calibrateOnIndependentCells(const MarkovModel &model,
                                                               const AnalysisSettings &settings,
                                                               const RunContext &context = {}, double cellFrames = 4e7);

/// The threshold in nats that the decide settings ask for.
double thresholdNats(const DecideSettings &decide, const Calibration &calibration, double cellFramesPerHour);

/// ln K in force, and the fraction of all states that go on with it.
struct ResetFit {
    double lnK = 0.0;
    double continuedFraction = 0.0;
};

/// Finds ln K on fields of noise, after the first 300 frames of each: by bisection for half of the states continued
/// where the settings ask for that, or measures what the given law does. Cost: about fifteen passes over the fields.
ResetFit fitReset(const std::vector<NormalisedFramesPointer> &noise, const MarkovModel &model, const SmdSettings &smd);

/// The reset rule that the settings ask for, given the ln K that was found.
ResetRule resetRule(const SmdSettings &settings, double lnK);

/// k_t and k_f of a spectrogram, for detectors stated in windows and cells.
FrameGeometry frameGeometry(const SpectrogramSettings &settings);

} // namespace faintline
