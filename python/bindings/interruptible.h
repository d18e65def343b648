#pragma once

#include "base/RunContext.h"

#include <pybind11/pybind11.h>

#include <functional>

namespace faintline::python {

/// What every long call takes besides its inputs.
struct RunOptions {
    int threads = 0;           ///< 0: as many as the machine has
    pybind11::object progress; ///< None, or called as progress(fraction, what) by the thread that called
};

/// Runs `work` on a thread of its own while the calling one, the GIL released, listens: it passes progress on ten times
/// a second and asks the work to stop when Ctrl+C was pressed or `progress` raised; that exception is then thrown.
/// Otherwise throws what `work` threw.
///
/// Precondition: the GIL is held; `work` touches no Python object.
void runInterruptibly(const RunOptions &options, const std::function<void(const RunContext &context)> &work);

} // namespace faintline::python
