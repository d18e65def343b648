#pragma once

#include <string>
#include <vector>

namespace faintline {

/// SHA-256 of a file's bytes as lower-case hexadecimal digits; of its first and last mebibyte and its length where it
/// is larger than 64 MiB, so that it stays quick ("part:" stands before such a hash).
std::string fileHash(const std::string &path);

/// One of many files, in their order: of the first and last 64 KiB of each and its length ("files:" stands before it).
std::string filesHash(const std::vector<std::string> &paths);

} // namespace faintline
