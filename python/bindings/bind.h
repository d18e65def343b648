#pragma once

#include <pybind11/pybind11.h>

namespace faintline::python {

/// Each function adds one part to the module. Classes that others refer to come first.
void bindErrors(pybind11::module_ &module);
void bindAxis(pybind11::module_ &module);
void bindRecording(pybind11::module_ &module);
void bindFrames(pybind11::module_ &module);
void bindOpen(pybind11::module_ &module);
void bindSimulate(pybind11::module_ &module);
void bindTrack(pybind11::module_ &module);
void bindExplanation(pybind11::module_ &module);
void bindResult(pybind11::module_ &module);
void bindDetect(pybind11::module_ &module);
void bindDetector(pybind11::module_ &module);
void bindPaths(pybind11::module_ &module);
void bindEvaluate(pybind11::module_ &module);
void bindSettings(pybind11::module_ &module);

} // namespace faintline::python
