#pragma once

#include "live/SampleSource.h"

#include <functional>
#include <span>
#include <string>

namespace faintline {

/// What the header of a WAV file says that comes through a pipe, whose lengths mean nothing: RIFF or RF64, integers of
/// 8, 16, 24 and 32 bits, floats of 32 and 64.
struct WavHeader {
    StreamFormat format; ///< integers of 24 bits as ones of 32, by `expand24`
    bool isPacked24 = false;
};

/// Reads as far as the first sample. `read` fills in all it is given, or answers false where the stream ends. Throws
/// Error{where, what is wrong and what would be accepted}.
WavHeader readWavHeader(const std::function<bool(std::span<std::byte>)> &read, const std::string &where);

/// Integers of 24 bits, little-endian, as ones of 32: the same values, three bytes to four.
std::vector<std::byte> expand24(std::span<const std::byte> bytes);

} // namespace faintline
