#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

#include <vector>

namespace faintline {

/// Quantity of a spectrum's values.
enum class SpectrumQuantity {
    OverNoise, ///< y: power over the noise's mean power
    Density    ///< power per Hz, of samples whose full scale is 1; one-sided for real samples
};

/// Spectra of one frame and of the mean of many, along the last axis of frames on one axis; for a family, along the
/// frequencies of its members.
struct Spectra {
    std::vector<double> position; ///< Hz
    std::vector<double> frame;
    std::vector<double> mean;
};

/// An interval that includes both ends.
struct TimeSpan {
    double fromSeconds = 0.0;
    double toSeconds = 0.0;
};

/// The frame nearest to `seconds`, and the mean over `time`: of all its frames, or of 400 evenly spread ones. Values
/// that were not observed are omitted from the mean and NaN in a frame. A density needs a recording.
///
///   density = power/f_s for complex samples, twice that for real ones
///
/// Oracle: white noise of variance σ² has the density 2σ²/f_s. Throws Cancelled.
Spectra spectraOf(const Analysis &analysis, double seconds, const TimeSpan &time, SpectrumQuantity quantity,
                  const RunContext &context = {});

} // namespace faintline
