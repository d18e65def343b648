#pragma once

#include "base/json.h"
#include "plan/AnalysisSettings.h"
#include "scene/LineScene.h"

#include <string>
#include <vector>

namespace faintline {

/// A detector in an experiment, with its settings.
struct DetectorUnderTest {
    std::string name;
    AnalysisSettings settings; ///< model and detector are used; the spectrogram is the experiment's
    /// `detect` as a whole, from samples to tracks, with all these settings except selection and false alarms, which are
    /// the experiment's. Its statistic is the margin of a track over the threshold (lineDetection.h).
    bool isWhole = false;

    bool operator==(const DetectorUnderTest &) const = default;
};

/// The list under the key "detectors", [{"name": …, "settings": {…}, "whole": false}]; throws Error.
std::vector<DetectorUnderTest> detectorsFromJson(const Json &json, const std::string &where);
Json toJson(const std::vector<DetectorUnderTest> &detectorsUnderTest);

/// Detection of simulated lines in white noise, as in Billon 2005 section 5.
///
/// A *run* is a field of `frames` × `bins` cells of noise, evaluated alone and with one line in each of its blocks of
/// `blockFrames` × `blockBins` cells. All lines of a run have the same SNR, duration and wander; onset, frequency and
/// phase are random. Frequencies are in resolution cells 1/T_FT, times in windows T_FT.
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
    Fluctuation fluctuation = Fluctuation::None; ///< Swerling 2 and 4: from window to window
    std::vector<DetectorUnderTest> detectors{};

    static const std::vector<Field<LineExperiment>> &fields();
    bool operator==(const LineExperiment &) const = default;

    static constexpr int windowSamples = 250;
    int bins() const { return windowSamples * binsPerCell; }
    int blocksInTime() const { return frames / blockFrames; }
    int blocksInFrequency() const { return bins() / blockBins; }
    int signalsPerRun() const { return blocksInTime() * blocksInFrequency(); }
    int signalFrames() const;
};

/// Throws Error if lines do not fit into their blocks, or there is no SNR or detector.
void checkExperiment(const LineExperiment &experiment);

/// {"kind": "lines", "snrDb": […], …, "detectors": [{"name": …, "settings": {"model.lowestSlope": 0, …}}]}; throws
/// Error.
LineExperiment lineExperimentFromJson(const Json &json, const std::string &where);
Json toJson(const LineExperiment &experiment);

} // namespace faintline
