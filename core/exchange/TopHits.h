#pragma once

#include "analysis/Analysis.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// A drifting narrow-band signal as a table of hits has it.
struct TopHit {
    double driftHzPerSecond = 0.0; ///< of the straight line through its track
    double snr = 0.0;
    double startHz = 0.0; ///< where that line lies in the observation's first frame
    Index channel = 0;    ///< in which that is, counted from the lowest
    double lowHz = 0.0;   ///< of the track
    double highHz = 0.0;
};

/// One table, turboSETI's .dat: what was observed, and a line a signal.
struct TopHits {
    std::string source;
    std::optional<double> startUnixSeconds; ///< of the first frame's middle
    double frameSeconds = 0.0;
    double channelHz = 0.0;
    double durationSeconds = 0.0;
    std::vector<TopHit> hits;

    double driftStep() const { return channelHz / durationSeconds; } ///< Hz/s
};

/// What a table says besides the signals.
struct Observation {
    std::string name;
    std::optional<double> startUnixSeconds; ///< of the first sample or frame
    double centreHz = 0.0;                  ///< added to all frequencies
};

/// The signals of an analysis, strongest first, from `leastSnr` on.
///
///   SNR = Σ_t z(t)/√T,   Q(z(t)) = e^(-y(t)),   z ≥ 0
///
/// summed over the T frames along a track's path, in each the larger of its cell and the two beside it; Q: upper tail
/// of the normal law. So z is the deviation of Gaussian noise that is as rare as y is on noise, and the sum over √T
/// is turboSETI's SNR where its noise is Gaussian. Frames that were not observed do not count. Throws Error for frames
/// that are no spectra.
TopHits topHits(const Analysis &analysis, const Observation &observation, double leastSnr);

/// The table in turboSETI's columns (.dat): MHz, Hz/s. Corrected and uncorrected frequency are both startHz; nothing is
/// known of SEFD and coarse channels.
std::string topHitsText(const TopHits &table);

/// Reads such a table, also turboSETI's own. Throws Error naming `path`.
TopHits readTopHits(const std::string &path);

/// z of which Q(z) = e^(-y); 0 where that is less than 0.
double gaussianDeviate(double y);

} // namespace faintline
