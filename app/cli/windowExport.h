#pragma once

#include "base/RunContext.h"
#include "base/json.h"

#include <functional>
#include <string>

namespace faintline::cli {

/// Whether a provenance was written by the window, which has no command line to repeat.
bool isOfWindow(const Json &provenance);

/// A table that the window exported.
struct WindowExport {
    Json provenance;
    std::string path;
    std::string recording; ///< that it was made from; empty: the file of its name beside the table
    /// Throws for a file that the provenance names where it must not be read.
    std::function<void(const std::string &path)> mayRead;
};

/// Makes it again as `out`, whose extension says of what kind: events with what was said about them, their tracks, the curve of an
/// experiment, a Doppler fit, or a straightened recording. Throws Error, in one line, for what only the window can
/// make.
void remake(const WindowExport &table, const std::string &out, const RunContext &context);

} // namespace faintline::cli
