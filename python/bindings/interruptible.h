#pragma once

#include "base/RunContext.h"

#include <pybind11/pybind11.h>

#include <functional>

namespace faintline::python {

/// Common arguments of all long calls.
struct RunOptions {
    int threads = 0;           ///< 0: as many as the machine has
    pybind11::object progress; ///< None, or called as progress(fraction, what) on the calling thread
};

/// Runs `work` on a separate thread while the calling thread, with the GIL released, waits: it reports progress ten
/// times a second and stops the work if Ctrl+C was pressed or `progress` raised an exception, which is then thrown.
/// Exceptions of `work` are passed on.
///
/// Precondition: the GIL is held; `work` touches no Python object.
void runInterruptibly(const RunOptions &options, const std::function<void(const RunContext &context)> &work);

} // namespace faintline::python
