#include "signal/formats/SampleType.h"

#include "base/Error.h"
#include "base/oneLine.h"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace faintline {

namespace {

    constexpr std::array<std::string_view, 8> numberNames{"f32", "f64", "i8", "i16", "i32", "u8", "u16", "u32"};

    template <int bytes>
    using Bits = std::conditional_t<
        bytes == 1, std::uint8_t,
        std::conditional_t<bytes == 2, std::uint16_t, std::conditional_t<bytes == 4, std::uint32_t, std::uint64_t>>>;

    template <class T>
    T reversed(T value)
    {
        if constexpr (sizeof(T) == 2)
            return __builtin_bswap16(value);
        else if constexpr (sizeof(T) == 4)
            return __builtin_bswap32(value);
        else if constexpr (sizeof(T) == 8)
            return __builtin_bswap64(value);
        else
            return value;
    }

    template <SampleType::Number number, int bytes>
    float toFloat(Bits<bytes> bits)
    {
        if constexpr (number == SampleType::Number::Float) {
            return float(std::bit_cast<std::conditional_t<bytes == 4, float, double>>(bits));
        } else {
            // Inverting the highest bit of an unsigned number gives the signed number relative to mid-scale.
            constexpr auto signBit = static_cast<Bits<bytes>>(Bits<bytes>(1) << (8 * bytes - 1));
            if constexpr (number == SampleType::Number::Unsigned)
                bits = static_cast<Bits<bytes>>(bits ^ signBit);
            return float(static_cast<std::make_signed_t<Bits<bytes>>>(bits)) * (1.0f / float(signBit));
        }
    }

    /// Layout of samples in memory.
    struct SampleLayout {
        Index stride;   ///< bytes between samples
        int components; ///< adjacent numbers of each
        bool isReversed;
    };

    template <SampleType::Number number, int bytes>
    void convert(const std::byte *in, SampleLayout layout, float *out, Index count)
    {
        const auto [stride, components, isReversed] = layout;
        for (Index i = 0; i < count; ++i)
            for (int c = 0; c < components; ++c) {
                Bits<bytes> bits;
                std::memcpy(&bits, in + i * stride + c * bytes, sizeof bits);
                out[i * components + c] = toFloat<number, bytes>(isReversed ? reversed(bits) : bits);
            }
    }

    /// The same with a compile-time stride for adjacent samples, so that the compiler vectorises it.
    template <SampleType::Number number, int bytes>
    void convertFast(const std::byte *in, SampleLayout layout, float *out, Index count)
    {
        if (layout.stride != layout.components * bytes)
            convert<number, bytes>(in, layout, out, count);
        else if (layout.isReversed)
            convert<number, bytes>(in, {bytes, 1, true}, out, count * layout.components);
        else
            convert<number, bytes>(in, {bytes, 1, false}, out, count * layout.components);
    }

} // namespace

std::string SampleType::name() const
{
    const char kind = number == Number::Float ? 'f' : number == Number::Signed ? 'i' : 'u';
    std::string result = {isComplex ? 'c' : 'r', kind};
    result += std::to_string(8 * bytes);
    return bytes == 1 ? result : result + (isBigEndian ? "_be" : "_le");
}

std::string sampleTypeList()
{
    return listed(numberNames, [](std::string_view number) { return "c" + std::string(number); })
           + " (complex) or the same with r (real), with _le or _be for the byte order";
}

SampleType parseSampleType(std::string_view name, const std::string &where)
{
    SampleType type;
    std::string_view rest = name;
    const bool hasKind = rest.starts_with('c') || rest.starts_with('r');
    type.isComplex = rest.starts_with('c');
    rest.remove_prefix(hasKind ? 1 : 0);
    bool hasOrder = true;
    if (rest.ends_with("_be"))
        type.isBigEndian = true;
    else
        hasOrder = rest.ends_with("_le");
    rest.remove_suffix(hasOrder ? 3 : 0);
    for (const std::string_view known : numberNames)
        if (hasKind && rest == known) {
            type.number = rest[0] == 'f'   ? SampleType::Number::Float
                          : rest[0] == 'i' ? SampleType::Number::Signed
                                           : SampleType::Number::Unsigned;
            const std::string_view bits = rest.substr(1);
            type.bytes = bits == "8" ? 1 : bits == "16" ? 2 : bits == "32" ? 4 : 8;
            type.isBigEndian = type.isBigEndian && type.bytes > 1;
            return type;
        }
    throw Error(where, std::string(name.substr(0, 40)) + " is not a sample type; expected one of " + sampleTypeList());
}

void convertSamples(const SampleType &type, std::span<const std::byte> bytes, Index stride, std::span<float> out)
{
    using Number = SampleType::Number;
    const int components = type.isComplex ? 2 : 1;
    const SampleLayout layout{stride, components, type.isBigEndian != (std::endian::native == std::endian::big)};
    const auto run = [&](auto convertOne) {
        convertOne(bytes.data(), layout, out.data(), std::ssize(out) / components);
    };
    switch (type.number) {
    case Number::Float:
        return type.bytes == 4 ? run(convertFast<Number::Float, 4>) : run(convertFast<Number::Float, 8>);
    case Number::Signed:
        return type.bytes == 1   ? run(convertFast<Number::Signed, 1>)
               : type.bytes == 2 ? run(convertFast<Number::Signed, 2>)
                                 : run(convertFast<Number::Signed, 4>);
    case Number::Unsigned:
        if (type.bytes == 1 && type.isComplex) {
            run(convertFast<Number::Unsigned, 1>);
            for (float &value : out)
                value += iqByteShift;
            return;
        }
        return type.bytes == 1   ? run(convertFast<Number::Unsigned, 1>)
               : type.bytes == 2 ? run(convertFast<Number::Unsigned, 2>)
                                 : run(convertFast<Number::Unsigned, 4>);
    }
}

} // namespace faintline
