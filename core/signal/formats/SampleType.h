#pragma once

#include "base/Axis.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace faintline {

/// Encoding of one sample of a raw file, by SigMF's names: c or r (complex, real), f, i or u (float, signed, unsigned
/// integer), bits, and _le or _be if there is more than one byte: "ci16_le", "rf32_be", "cu8".
struct SampleType {
    enum class Number { Float, Signed, Unsigned };

    bool isComplex = false;
    Number number = Number::Float;
    int bytes = 4; ///< of one number; a complex sample has two
    bool isBigEndian = false;

    Index sampleBytes() const { return bytes * (isComplex ? 2 : 1); }
    std::string name() const;

    bool operator==(const SampleType &) const = default;
};

/// Parses a type name. A missing byte order means little-endian. Throws Error{where, …} listing the types.
SampleType parseSampleType(std::string_view name, const std::string &where);

/// "cf32, ci16, … " for messages and forms.
std::string sampleTypeList();

/// What a byte of I or Q lacks of its receiver's scale: that is symmetric, so 0 lies between 127 and 128, while 128 is 0
/// in sound. In units of full scale.
constexpr float iqByteShift = 0.5f / 128.0f;

/// Converts samples spaced `stride` bytes apart to floats, with integers scaled to ±1 (unsigned: ½ of full scale is 0,
/// but for bytes of I and Q).
/// `out` takes one float per real sample, two per complex one.
void convertSamples(const SampleType &type, std::span<const std::byte> bytes, Index stride, std::span<float> out);

} // namespace faintline
