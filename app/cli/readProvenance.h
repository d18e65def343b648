#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace faintline::cli {

/// What stands beside a result: the command line that wrote it, the folder it ran in, its version, what it read and
/// wrote.
struct Provenance {
    std::string version;
    std::filesystem::path folder;
    std::vector<std::string> arguments;
    std::vector<std::pair<std::string, std::string>> inputs; ///< name, hash
    std::vector<std::string> outputs;
};

/// Without what stands before the sub-command: threads and progress, which change no byte.
std::vector<std::string> fromCommandOn(const std::vector<std::string> &arguments);

/// Of what `detect`, `compare`, `simulate` or `inject` wrote; the sub-command is the first argument. Throws Error.
Provenance readProvenance(const std::string &path);

} // namespace faintline::cli
