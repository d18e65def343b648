#pragma once

#include "base/RunContext.h"
#include "signal/Recording.h"

#include <vector>

namespace faintline {

/// A time interval of one channel, and a band around a frequency.
struct Stretch {
    int channel = 0;
    double fromSeconds = 0.0;
    double toSeconds = 0.0;
    double hz = 0.0;
    double halfBandHz = 0.0;
};

/// The highest line of a stretch.
struct LineHeight {
    double hz = 0.0;
    double db = 0.0; ///< above the median of the band; ∞ if that is silent
};

/// Spectrum of a stretch's band.
struct LineSpectrum {
    std::vector<double> hz;
    std::vector<double> db; ///< above the median of the band; ∞ or NaN if that is silent
};

/// The band in one Hann-windowed transform of the whole stretch; lineHeight gives its highest line.
LineSpectrum lineSpectrum(const Recording &recording, const Stretch &stretch, const RunContext &context = {});

/// The highest line in the band, in one Hann-windowed transform of the whole stretch; resolution 1.5 over its duration.
///
/// The band is mixed down and decimated to as few samples as can represent it, at most 2²², so that hours are possible;
/// of a longer stretch its middle is used. Throws Error if it holds less than 16 samples, Cancelled.
LineHeight lineHeight(const Recording &recording, const Stretch &stretch, const RunContext &context = {});

} // namespace faintline
