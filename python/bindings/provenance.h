#pragma once

#include "analysis/AnalysisSettings.h"

#include <string>
#include <utility>
#include <vector>

namespace faintline::python {

/// How the command line would find the same: the arguments that name the source, and the settings.
struct Origin {
    std::vector<std::string> source; ///< a file, then options of reading it; none of what came from memory
    AnalysisSettings settings;       ///< as they were asked for
};

/// Writes beside each output what it was made from, as `faintline-cli detect` does: with it `faintline-cli replay` makes
/// the output again. `outputs`: option and file; empty names are none. Nothing is written where the source is no file.
void writeProvenance(const Origin &origin, const std::vector<std::pair<std::string, std::string>> &outputs);

} // namespace faintline::python
