#pragma once

#include "base/RunContext.h"
#include "base/json.h"

#include <functional>
#include <string>

namespace faintline::cli {

/// Whether the window wrote a provenance, which then has no command line to repeat.
bool isOfWindow(const Json &provenance);

/// A table that the window exported.
struct WindowExport {
    Json provenance;
    std::string path;
    std::string recording; ///< source recording; empty: the file with its name beside the table
    /// Throws for files named in the provenance that must not be read.
    std::function<void(const std::string &path)> mayRead;
};

/// Regenerates the table as `out`, whose extension determines its kind: events with reviews, their tracks, the curve of
/// an experiment, a Doppler fit, or a straightened recording. Throws Error for tables that only the window can make.
void remake(const WindowExport &table, const std::string &out, const RunContext &context);

} // namespace faintline::cli
