#pragma once

#include "base/json.h"
#include "recording/Recording.h"
#include "spectrum/NormalisedFrames.h"
#include "spectrum/PowerFrames.h"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

namespace faintline::python {

/// A recording as Python holds it: with the truth where it was simulated.
struct HeldRecording {
    RecordingPointer recording;
    Json truth; ///< null where it is not known
    /// Arguments with which the command line opens the same; none of what is in memory.
    std::vector<std::string> arguments{};
};

/// Frames as Python holds them.
struct HeldFrames {
    NormalisedFramesPointer frames;
    Json truth;
    bool isPings = false; ///< a sonar's, whose settings start from the preset "sonar"
    /// Of a file of power, which settings take a part of and normalise anew.
    std::shared_ptr<const PowerFrames> power{};
    std::vector<std::string> arguments{}; ///< as a recording's
};

/// Opens what a path names: a recording, ready-made frames, or a scene to simulate. Throws Error.
pybind11::object openSource(const std::string &path, const pybind11::kwargs &options = {});

/// A recording or frames from samples or frames in an array. Throws Error.
HeldRecording recordingOfArray(const pybind11::object &samples, double rateHz, double centreHz);
HeldFrames framesOfArray(const pybind11::object &values, const pybind11::object &axes, const pybind11::object &time);

/// What a scene describes, as a recording or as frames.
pybind11::object simulatedSource(const Json &scene, const std::string &where, int seed = -1);

} // namespace faintline::python
