#pragma once

#include <string>

namespace faintline {

/// SHA-256 of a file's bytes as lower-case hexadecimal digits; of its first and last mebibyte and its length where it
/// is larger than 64 MiB, so that it stays quick ("part:" stands before such a hash).
std::string fileHash(const std::string &path);

} // namespace faintline
