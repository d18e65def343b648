#pragma once

#include <string>
#include <string_view>

namespace faintline {

/// 64-bit FNV-1a as sixteen hexadecimal digits: tells what was cut short, mixed up or changed by hand, and names files.
/// Nobody who means to deceive is kept from it; where that matters, SHA-256 is in recording/fileHash.h.
std::string checksum(std::string_view text);

} // namespace faintline
