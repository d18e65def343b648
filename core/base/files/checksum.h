#pragma once

#include <string>
#include <string_view>

namespace faintline {

/// 64-bit FNV-1a as sixteen hexadecimal digits. Names files and detects truncation, mix-ups and manual changes. It does
/// not protect against deliberate forgery; use SHA-256 (signal/fileHash.h) for that.
std::string checksum(std::string_view text);

} // namespace faintline
