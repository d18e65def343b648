#pragma once

#include "analysis/Analysis.h"
#include "base/RunContext.h"

#include <vector>

namespace faintline {

/// What the values of a spectrum are.
enum class SpectrumLevel {
    OverNoise, ///< y: power over the noise's mean power
    Density    ///< power per Hz, of samples whose full scale is 1; one-sided for real samples
};

/// One frame, and the mean of many, along the last axis of frames on one axis; where a family is looked for, along the
/// frequencies of its members.
struct Spectra {
    std::vector<double> position; ///< Hz
    std::vector<double> frame;
    std::vector<double> mean;
};

/// From … to, both included.
struct TimeSpan {
    double fromSeconds = 0.0;
    double toSeconds = 0.0;
};

/// The frame nearest to `seconds`, and the mean over `time`: of all its frames, or of 400 that lie evenly in it. What
/// was not observed is left out of the mean and NaN in a frame. A density needs a recording (`spectrogram()`).
///
///   density = y·4^e/f_s for complex samples, twice that for real ones;  e = scaleExponent
///
/// Oracle: white noise of variance σ² has the density 2σ²/f_s. Throws Cancelled.
Spectra spectraOf(const Analysis &analysis, double seconds, const TimeSpan &time, SpectrumLevel level,
                  const RunContext &context = {});

} // namespace faintline
