#pragma once

#include "plan/Analysis.h"

#include <pybind11/numpy.h>

namespace faintline::python {

/// The events of an analysis as a structured array, one record per event, with the names of the command line's CSV
/// columns.
pybind11::array eventArray(const Analysis &analysis);

/// The areas of raised level without a line, with the names of the command line's JSON.
pybind11::array areaArray(const Analysis &analysis);

} // namespace faintline::python
