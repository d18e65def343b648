#pragma once

#include "plan/AnalysisSettings.h"

#include <string>
#include <utility>
#include <vector>

namespace faintline::python {

/// Input with which the command line gives the same result: the arguments for the source, and the settings.
struct Origin {
    std::vector<std::string> source; ///< a file, then options for reading it; empty for sources in memory
    AnalysisSettings settings;       ///< as given by the caller
};

/// Writes the provenance beside each output, as `faintline-cli detect` does; `faintline-cli replay` reproduces the
/// output from it. `outputs`: option and file; empty names are ignored. Writes nothing if the source is not a file.
void writeProvenance(const Origin &origin, const std::vector<std::pair<std::string, std::string>> &outputs);

} // namespace faintline::python
