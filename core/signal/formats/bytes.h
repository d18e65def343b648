#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace faintline {

// What bytes of a file mean.

/// A whole number of at most eight bytes, the lowest or the highest byte first.
inline std::uint64_t littleEndian(std::span<const std::byte> bytes)
{
    std::uint64_t value = 0;
    for (std::size_t i = bytes.size(); i-- > 0;)
        value = value << 8 | std::to_integer<std::uint64_t>(bytes[i]);
    return value;
}
inline std::uint64_t bigEndian(std::span<const std::byte> bytes)
{
    std::uint64_t value = 0;
    for (const std::byte byte : bytes)
        value = value << 8 | std::to_integer<std::uint64_t>(byte);
    return value;
}

/// A number as it lies in memory, at a place that need not be aligned.
template <class T>
T numberAt(std::span<const std::byte> bytes, std::size_t at = 0)
{
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

inline std::string_view asText(std::span<const std::byte> bytes)
{
    return {reinterpret_cast<const char *>(bytes.data()), bytes.size()};
}

} // namespace faintline
