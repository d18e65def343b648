#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace faintline::cli {

/// Content of a provenance file: the command line, its folder and version, inputs and outputs.
struct Provenance {
    std::string version;
    std::filesystem::path folder;
    std::vector<std::string> arguments;
    std::vector<std::pair<std::string, std::string>> inputs; ///< name, hash
    std::vector<std::string> outputs;
};

/// Removes everything before the sub-command: threads and progress, which do not change results.
std::vector<std::string> fromCommandOn(const std::vector<std::string> &arguments);

/// Reads the provenance of an output of `detect`, `compare`, `simulate` or `inject`; the sub-command is the first
/// argument. Throws Error.
Provenance readProvenance(const std::string &path);

} // namespace faintline::cli
