#pragma once

#include "evaluate/experiments/Experiment.h"
#include "scene/Truth.h"
#include "signal/Recording.h"

#include <complex>
#include <span>
#include <vector>

namespace faintline {

// Data of one run of the experiment (Experiment.h).

/// True position of a line in the field.
struct Place {
    Index firstFrame = 0;
    std::vector<Index> bins; ///< one per frame of its duration
};

/// The field of one run: noise, and unit-SNR signals that can be added at any strength.
struct NoisyField {
    std::vector<std::complex<float>> noise;  ///< frames × bins
    std::vector<std::complex<float>> signal; ///< of SNR 1
    std::vector<Place> places;
    /// The samples of noise and signal, interleaved, at 250 Hz: a window lasts one second.
    std::vector<float> noiseSamples, signalSamples;
    std::vector<TruthLine> truths; ///< one per place, in seconds and in Hz from the field's lowest frequency
};

/// Sliding transforms of interleaved complex samples, frames × bins, scaled to unit noise variance.
std::vector<std::complex<float>> fieldTransform(const Experiment &experiment, std::span<const float> samples);

/// Generates the run's noise only.
void makeNoise(const Experiment &experiment, int run, NoisyField &field);

NoisyField makeField(const Experiment &experiment, int run);

/// The samples noise + amplitude·signal as a recording.
RecordingPointer recordingOf(const Experiment &experiment, const NoisyField &field, float amplitude);

/// y = |noise + amplitude·signal|² of one frame of `bins` values.
void powerOf(const NoisyField &field, Index bins, Index frame, float amplitude, std::span<float> y);

} // namespace faintline
