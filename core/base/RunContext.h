#pragma once

#include "base/Error.h"

#include <functional>
#include <stop_token>
#include <string_view>

namespace faintline {

/// Context of a long computation: stop request, progress callback, number of threads.
///
/// It must not change a byte of a result.
struct RunContext {
    std::stop_token stop;
    /// Called now and then from the computing thread with a fraction in 0 … 1 and the current activity.
    std::function<void(double fraction, std::string_view what)> progress;
    int threads = 1;

    /// Reports progress and throws Cancelled if the computation was asked to stop.
    void checkpoint(double fraction, std::string_view what) const
    {
        if (stop.stop_requested())
            throw Cancelled();
        if (progress)
            progress(fraction, what);
    }

    /// The same context with progress mapped to the part [from, to] of the whole.
    RunContext part(double from, double to) const
    {
        RunContext inner = *this;
        if (progress)
            inner.progress = [outer = progress, from, to](double fraction, std::string_view what) {
                outer(from + (to - from) * fraction, what);
            };
        return inner;
    }
};

} // namespace faintline
