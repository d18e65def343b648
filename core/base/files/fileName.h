#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// Converts a file name to valid UTF-8 and back. Names are bytes; JSON and labels hold text. A byte that is not part of
/// a character maps to U+10FE00 + byte, in a private-use area (KDE's convention); so does every byte of a character of
/// that area.
std::string textFromFileName(std::string_view name);
std::string fileNameFromText(std::string_view text);

/// Whether a path leads to a file, not to a folder, a pipe or a device.
bool isFile(const std::string &path);

/// Whether a path has the given ending, ignoring case.
bool hasEnding(std::string_view path, std::string_view ending);

/// Throws an Error that lists the accepted endings if the path has none of them.
void checkEnding(const std::string &path, const std::vector<std::string> &endings);

} // namespace faintline
