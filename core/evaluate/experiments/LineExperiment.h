#pragma once

#include "analysis/AnalysisSettings.h"
#include "base/RunContext.h"
#include "base/json.h"
#include "recording/LineScene.h"
#include "spectrum/NormalisedFrames.h"

#include <functional>
#include <string>
#include <vector>

namespace faintline {

/// One detector of an experiment, by the settings that lead to it.
struct DetectorUnderTest {
    std::string name;
    AnalysisSettings settings; ///< model and detector count; the spectrogram is the experiment's

    bool operator==(const DetectorUnderTest &) const = default;
};

/// The list under the key "detectors", [{"name": …, "settings": {…}}]; throws Error.
std::vector<DetectorUnderTest> detectorsFromJson(const Json &json, const std::string &where);
Json toJson(const std::vector<DetectorUnderTest> &detectorsUnderTest);

/// Detection of simulated lines in white noise, as in Billon 2005 section 5.
///
/// A *run* is a field of `frames` × `bins` cells of noise alone and the same noise with one line in each of its blocks
/// of `blockFrames` × `blockBins` cells. All lines of a run have the same SNR, duration and wander; onset, frequency
/// and phase are random. Frequencies are measured in resolution cells 1/T_FT, times in windows T_FT.
struct LineExperiment {
    int seed = 1;
    int runs = 20;
    int frames = 2000;
    int blockFrames = 300;
    int blockBins = 200;
    int stepsPerWindow = 2; ///< k_t
    int binsPerCell = 4;    ///< k_f
    WindowShape window = WindowShape::Rectangular;
    std::vector<double> snrDb{-1.0};
    double durationWindows = 100.0;
    double driftCellsPerWindow = 0.0;
    double wanderCells = 0.0; ///< standard deviation of the wander
    double wanderWindows = 15.0;
    Fading fading = Fading::None;
    double fadingWindows = 20.0;
    std::vector<DetectorUnderTest> detectors;

    static const std::vector<Field<LineExperiment>> &fields();
    bool operator==(const LineExperiment &) const = default;

    static constexpr int windowSamples = 250;
    int bins() const { return windowSamples * binsPerCell; }
    int blocksInTime() const { return frames / blockFrames; }
    int blocksInFrequency() const { return bins() / blockBins; }
    int signalsPerRun() const { return blocksInTime() * blocksInFrequency(); }
    int signalFrames() const;
};

/// Throws Error where lines do not fit into their blocks, or there is no SNR or detector.
void checkExperiment(const LineExperiment &experiment);

/// {"kind": "lines", "snrDb": […], …, "detectors": [{"name": …, "settings": {"model.lowestSlope": 0, …}}]}; throws
/// Error.
LineExperiment lineExperimentFromJson(const Json &json, const std::string &where);
Json toJson(const LineExperiment &experiment);

/// What one run leaves behind: all that any estimate of Pd, Pfa or ROC needs.
struct RunOutcome {
    int run = 0;
    /// [detector][block]: largest D on the noise alone.
    std::vector<std::vector<float>> noise;
    /// [detector][SNR][signal]: largest D at the line's own frequency while it lasts.
    std::vector<std::vector<std::vector<float>>> signal;

    bool operator==(const RunOutcome &) const = default;
};

/// The reset rule of every detector of the experiment, K found on the experiment's own noise (default for those without
/// one).
std::vector<ResetRule> calibratedResets(const LineExperiment &experiment, const RunContext &context = {});

/// Called with every finished run, in any order, from one thread at a time.
using RunSink = std::function<void(const RunOutcome &)>;

/// Does the given runs, on context.threads threads; the answer is in the order of `runs` and depends on nothing but the
/// experiment. K of sequential Markov detectors is calibrated first. Throws Error, Cancelled.
std::vector<RunOutcome> runExperiment(const LineExperiment &experiment, const std::vector<int> &runs,
                                      const RunContext &context = {}, const RunSink &sink = {});

/// One signal of one run made again, by itself.
struct LineTrial {
    /// Its block, y with noise of mean 1; bins as frequency in cells, frames as windows.
    std::shared_ptr<const FrameArray> frames;
    Index firstFrame = 0;    ///< of the line, in the block
    std::vector<Index> path; ///< its bin in the block, one per frame of its duration
};
LineTrial remakeTrial(const LineExperiment &experiment, double snrDb, int run, int signal);

} // namespace faintline
