#pragma once

#include <string>
#include <vector>

namespace faintline {

/// SHA-256 of a file's bytes as lower-case hexadecimal digits. For files larger than 64 MiB, only the first and last
/// mebibyte and the length are hashed, to stay fast; such a hash begins with "part:".
std::string fileHash(const std::string &path);

/// Hash of many files in their order, from the first and last 64 KiB and the length of each; it begins with "files:".
std::string filesHash(const std::vector<std::string> &paths);

} // namespace faintline
