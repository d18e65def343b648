#pragma once

#include "evaluate/experiments/LineExperiment.h"
#include "scene/Truth.h"
#include "signal/Fft.h"
#include "signal/Recording.h"

#include <complex>
#include <memory>
#include <span>
#include <vector>

namespace faintline {

// Data of one run of the experiment (LineExperiment.h).

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

/// Sliding transforms of interleaved complex samples, scaled to unit noise variance. Use one object per thread.
class FieldTransform
{
public:
    explicit FieldTransform(const LineExperiment &experiment);

    void run(std::span<const float> samples, std::vector<std::complex<float>> &out);

private:
    Index m_hop;
    Index m_frames;
    Index m_bins;
    std::vector<float> m_window;
    Fft m_fft;
    std::unique_ptr<Fft::Buffer> m_buffer;
};

/// Generates the run's noise only.
void makeNoise(const LineExperiment &experiment, int run, FieldTransform &transform, NoisyField &field);

NoisyField makeField(const LineExperiment &experiment, int run, FieldTransform &transform);

/// The samples noise + amplitude·signal as a recording.
RecordingPointer recordingOf(const LineExperiment &experiment, const NoisyField &field, float amplitude);

/// y = |noise + amplitude·signal|² of one frame of `bins` values.
void powerOf(const NoisyField &field, Index bins, Index frame, float amplitude, std::span<float> y);

} // namespace faintline
