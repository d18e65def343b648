#pragma once

#include "live/SampleSource.h"

#include <functional>
#include <span>
#include <string>

namespace faintline {

/// Header of a piped WAV stream, whose length fields are ignored. Supports RIFF and RF64, integers of 8, 16, 24 and 32
/// bits, and floats of 32 and 64 bits.
struct WavHeader {
    StreamFormat format; ///< 24-bit integers appear as 32-bit, by `expand24`
    bool isPacked24 = false;
};

/// Reads up to the first sample. `read` fills the whole span, or returns false at the end of the stream. Throws
/// Error{where, what is wrong and what would be accepted}.
WavHeader readWavHeader(const std::function<bool(std::span<std::byte>)> &read, const std::string &where);

/// Converts 24-bit little-endian integers to 32-bit, three bytes to four; values relative to full scale stay the same.
std::vector<std::byte> expand24(std::span<const std::byte> bytes);

} // namespace faintline
