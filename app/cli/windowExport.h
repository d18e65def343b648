#pragma once

#include "base/RunContext.h"
#include "base/json.h"

#include <functional>
#include <string>

namespace faintline::cli {

/// Whether a provenance was written by the window, which has no command line to repeat.
bool isOfWindow(const Json &provenance);

/// Makes a table that the window exported again, as `out`, whose extension says of what kind: events with what was said
/// about them, or the curve of an experiment. `result` names the export; the recording is looked for beside it, unless
/// `recording` says where it is. `mayRead` throws for a file that the provenance names where it must not be read.
/// Throws Error, in one line, for what only the window can make.
void remakeWindowExport(const Json &provenance, const std::string &result, const std::string &recording,
                        const std::string &out, const std::function<void(const std::string &path)> &mayRead,
                        const RunContext &context);

} // namespace faintline::cli
