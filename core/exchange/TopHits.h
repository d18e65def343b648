#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// A drifting narrow-band signal as listed in a table of hits.
struct TopHit {
    double driftHzPerSecond = 0.0; ///< of the straight line through its track
    double snr = 0.0;
    double startHz = 0.0; ///< frequency of that line in the observation's first frame
    Index channel = 0;    ///< channel of startHz, counted from the lowest
    double lowHz = 0.0;   ///< of the track
    double highHz = 0.0;
};

/// One table (turboSETI's .dat): the observation, and one line per signal.
struct TopHits {
    std::string source;
    std::optional<double> startUnixSeconds; ///< of the first frame's middle
    double frameSeconds = 0.0;
    double channelHz = 0.0;
    double durationSeconds = 0.0;
    std::vector<TopHit> hits;

    double driftStep() const { return channelHz / durationSeconds; } ///< Hz/s
};

/// Properties of an observation besides the signals.
struct Observation {
    std::string name;
    std::optional<double> startUnixSeconds; ///< of the first sample or frame
    double centreHz = 0.0;                  ///< added to all frequencies
};

/// The signals of an analysis with at least `leastSnr`, strongest first.
///
///   SNR = Σ_t z(t)/√T,   Q(z(t)) = e^(-y(t)),   z ≥ 0
///
/// summed over the T frames along a track's path, using the largest of its cell and the two neighbours in each; Q:
/// upper tail of the normal law. z is the deviation of Gaussian noise that is as rare as y is on noise, and the sum
/// over √T equals turboSETI's SNR for Gaussian noise. Frames that were not observed do not count. Throws Error if
/// frames are not spectra.
TopHits topHits(const Analysis &analysis, const Observation &observation, double leastSnr);

/// The table in turboSETI's columns (.dat): MHz, Hz/s. Corrected and uncorrected frequency are both startHz; SEFD and
/// coarse channels are unknown.
std::string topHitsText(const TopHits &table);

/// Reads such a table, including turboSETI's own. Throws Error naming `path`.
TopHits readTopHits(const std::string &path);

/// z with Q(z) = e^(-y); 0 if that is negative.
double gaussianDeviate(double y);

/// A signal that is present in all observations on target, and in none off target.
struct CadenceEvent {
    std::vector<TopHit> hits; ///< one for each observation on target
};

/// Finds such signals in a cadence: observations alternately on target (the first, third, fifth …) and off it.
///
/// A hit is the same signal as one of another observation if that lies on the straight line through it, extrapolated,
/// within two channels plus half a drift step of both per second between them, and their drifts agree within two drift
/// steps. Of several matches the strongest counts. An event is a hit of the first observation with a match in all
/// others on target and in none off it. `slackHz` widens the tolerance.
///
/// Throws Error if there are fewer than two observations, or one has no start time; Cancelled.
std::vector<CadenceEvent> findCadence(const std::vector<TopHits> &observations, double slackHz = 0.0,
                                      const RunContext &context = {});

/// CSV with one line per event: drift, frequency and SNR of each observation on target.
std::string cadenceCsv(const std::vector<CadenceEvent> &events);

} // namespace faintline
