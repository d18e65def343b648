#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// A file's name as valid UTF-8, and back. Names are bytes; JSON and labels hold text. A byte that is no part of a
/// character stands for itself as U+10FE00 + byte (KDE's convention); so does every byte of a character of that
/// private-use area.
std::string textFromFileName(std::string_view name);
std::string fileNameFromText(std::string_view text);

/// Whether a file's name ends so, in small letters or capitals.
bool hasEnding(std::string_view path, std::string_view ending);

/// Throws an Error that lists them where a file's name ends in none of these.
void checkEnding(const std::string &path, const std::vector<std::string> &endings);

} // namespace faintline
