#pragma once

#include <string>
#include <vector>

namespace faintline::cli {

struct Common;

/// Writes OUTPUT.provenance.json beside each output, with the command line, its folder, the version, and hashes of the
/// inputs, from which `replay OUTPUT` repeats and compares the output. Empty names are ignored. Call it before writing
/// the outputs, within a CommitTogether, so that neither exists without the other.
void writeProvenance(const Common &common, const std::vector<std::string> &inputs,
                     const std::vector<std::string> &outputs);

} // namespace faintline::cli
