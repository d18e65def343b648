#pragma once

#include "base/RunContext.h"
#include "recording/Recording.h"

#include <vector>

namespace faintline {

/// A stretch of one channel, and a band around a frequency.
struct Stretch {
    int channel = 0;
    double fromSeconds = 0.0;
    double toSeconds = 0.0;
    double hz = 0.0;
    double halfBandHz = 0.0;
};

/// How far the highest line of a stretch stands out.
struct LineHeight {
    double hz = 0.0;
    double db = 0.0; ///< over the median of the band; ∞ where that is silent
};

/// The band of a stretch.
struct LineSpectrum {
    std::vector<double> hz;
    std::vector<double> db; ///< over the median of the band; ∞ or NaN where that is silent
};

/// The band in one Hann-windowed transform of the whole stretch, of which lineHeight tells the highest line.
LineSpectrum lineSpectrum(const Recording &recording, const Stretch &stretch, const RunContext &context = {});

/// The highest line in the band, in one Hann-windowed transform of the whole stretch; resolution 1.5 over its duration.
///
/// The band is mixed down and averaged to as few samples as hold it, so that hours are possible: at most 2²², of a
/// longer stretch its middle. Throws Error where it holds less than 16 samples, Cancelled.
LineHeight lineHeight(const Recording &recording, const Stretch &stretch, const RunContext &context = {});

} // namespace faintline
