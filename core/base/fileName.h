#pragma once

#include <string>
#include <string_view>

namespace faintline {

/// A file's name as valid UTF-8, and back. Names are bytes; JSON and labels hold text. A byte that is no part of a character stands for itself as
/// U+10FE00 + byte, from a private area that nobody's names use (KDE's convention).
std::string textFromFileName(std::string_view name);
std::string fileNameFromText(std::string_view text);

} // namespace faintline
