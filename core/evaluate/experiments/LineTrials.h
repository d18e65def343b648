#pragma once

#include "detect/Smd.h"
#include "evaluate/experiments/Experiment.h"
#include "evaluate/experiments/Trials.h"
#include "frames/NormalisedFrames.h"
#include "scene/Truth.h"
#include "signal/Recording.h"

#include <complex>
#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// The runs of lines in simulated noise. They need no thresholds.
class LineTrials : public Trials
{
public:
    /// Determines K of each detector on the experiment's own noise. Throws Error, Cancelled.
    explicit LineTrials(const Experiment &experiment, const RunContext &context = {});

    /// One rule per detector; the default for detectors without one.
    const std::vector<ResetRule> &resets() const { return m_resets; }

private:
    RunOutcome outcomeOf(int run, const RunContext &quiet) const override;

    Experiment m_experiment;
    std::vector<MarkovModel> m_models; ///< of each detector
    std::vector<ResetRule> m_resets;
};

/// With these, a detector that is `detect` as a whole analyses a field: one false alarm per block.
AnalysisSettings wholeSettings(const Experiment &experiment, std::size_t detector);

/// One signal of one run, regenerated alone.
struct LineTrial {
    /// Its block, y with noise of mean 1; the axes are frequency in cells and time in windows.
    std::shared_ptr<const FrameArray> frames;
    Index firstFrame = 0;    ///< of the line, in the block
    std::vector<Index> path; ///< its bin in the block, one per frame of its duration
};
LineTrial remakeTrial(const Experiment &experiment, double snrDb, int run, int signal);

/// One run with all its lines, and the truth of one of them.
MadeTrial remakeField(const Experiment &experiment, double snrDb, int run, int signal);

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
