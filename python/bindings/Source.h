#pragma once

#include "base/json.h"
#include "frames/NormalisedFrames.h"
#include "signal/PowerFrames.h"
#include "signal/Recording.h"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

namespace faintline::python {

/// Python object for a recording, with the truth if it was simulated.
struct HeldRecording {
    RecordingPointer recording;
    Json truth; ///< null if unknown
    /// Arguments with which the command line opens the same source; empty for sources in memory.
    std::vector<std::string> arguments{};
};

/// Python object for frames.
struct HeldFrames {
    NormalisedFramesPointer frames;
    Json truth;
    bool isPings = false; ///< sonar pings or scans; their settings start from those of `firstSettings`
    /// For a file of power, from which settings select a part, which is normalised again.
    std::shared_ptr<const PowerFrames> power{};
    std::vector<std::string> arguments{}; ///< as for a recording
};

/// Opens a file: a recording, ready-made frames, or a scene to simulate. Throws Error.
pybind11::object openSource(const std::string &path, const pybind11::kwargs &options = {});

/// Creates a recording or frames from an array. Throws Error.
HeldRecording recordingOfArray(const pybind11::object &samples, double rateHz, double centreHz);
HeldFrames framesOfArray(const pybind11::object &values, const pybind11::object &axes, const pybind11::object &time);

/// Simulates a scene as a recording or as frames.
pybind11::object simulatedSource(const Json &scene, const std::string &where, int seed = -1);

} // namespace faintline::python
