#pragma once

#include <string>
#include <vector>

namespace faintline::cli {

struct Common;

/// Writes beside each output what it was made from: OUTPUT.provenance.json with the command line, the folder it ran in,
/// the version, and the inputs' hashes. With it `replay OUTPUT` makes the output again and compares. Empty names are
/// none. Call it before the outputs are written, within a CommitTogether, and neither is there without the other.
void writeProvenance(const Common &common, const std::vector<std::string> &inputs,
                     const std::vector<std::string> &outputs);

} // namespace faintline::cli
