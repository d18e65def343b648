#include "live/wavHeader.h"

#include "base/Error.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

namespace faintline {

namespace {

    constexpr std::size_t largestFormatBytes = 4096;
    constexpr int mostChunks = 1000;
    constexpr const char *accepted =
        "give a WAV file, or say what the samples are (such as --raw-type ci16_le --raw-rate 48000)";

    std::uint32_t number(std::span<const std::byte> bytes, std::size_t at, std::size_t count)
    {
        std::uint32_t value = 0;
        for (std::size_t i = count; i-- > 0;)
            value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
        return value;
    }

    bool isTag(std::span<const std::byte> bytes, std::size_t at, std::string_view tag)
    {
        return std::equal(tag.begin(), tag.end(), bytes.begin() + std::ptrdiff_t(at),
                          [](char c, std::byte b) { return static_cast<char>(b) == c; });
    }

    /// Parses a "fmt " chunk.
    WavHeader headerOf(std::span<const std::byte> fmt, const std::string &where)
    {
        constexpr std::uint32_t pcm = 1;
        constexpr std::uint32_t ieee = 3;
        constexpr std::uint32_t extensible = 0xfffe;
        if (fmt.size() < 16)
            throw Error(where, std::string("its WAV header is incomplete; ") + accepted);
        std::uint32_t tag = number(fmt, 0, 2);
        if (tag == extensible && fmt.size() >= 26)
            tag = number(fmt, 24, 2);
        const std::uint32_t bits = number(fmt, 14, 2);
        WavHeader header;
        SampleType &type = header.format.type;
        const bool isInteger = tag == pcm && (bits == 8 || bits == 16 || bits == 24 || bits == 32);
        if (!isInteger && !(tag == ieee && (bits == 32 || bits == 64)))
            throw Error(where, "its WAV samples are of format " + std::to_string(tag) + " with " + std::to_string(bits)
                                   + " bits; integers of 8, 16, 24 or 32 bits and floats of 32 or 64 can be read");
        header.isPacked24 = bits == 24;
        type.number = tag == ieee ? SampleType::Number::Float
                      : bits == 8 ? SampleType::Number::Unsigned
                                  : SampleType::Number::Signed;
        type.bytes = header.isPacked24 ? 4 : int(bits / 8);
        header.format.channelCount = int(number(fmt, 2, 2));
        header.format.sampleRateHz = number(fmt, 4, 4);
        header.format.origin = "WAV";
        if (header.format.channelCount < 1 || header.format.channelCount > 1024 || header.format.sampleRateHz < 1.0)
            throw Error(where, "its WAV header gives " + std::to_string(header.format.channelCount) + " channels at "
                                   + std::to_string(number(fmt, 4, 4)) + " Hz");
        return header;
    }

} // namespace

WavHeader readWavHeader(const std::function<bool(std::span<std::byte>)> &read, const std::string &where)
{
    const auto fetch = [&](std::span<std::byte> bytes) {
        if (!read(bytes))
            throw Error(where, std::string("ended within its header; ") + accepted);
    };
    std::array<std::byte, 12> riff{};
    fetch(riff);
    if (!(isTag(riff, 0, "RIFF") || isTag(riff, 0, "RF64")) || !isTag(riff, 8, "WAVE"))
        throw Error(where, std::string("does not begin as a WAV file; ") + accepted);
    WavHeader header;
    bool isKnown = false;
    for (int chunk = 0; chunk < mostChunks; ++chunk) {
        std::array<std::byte, 8> head{};
        fetch(head);
        if (isTag(head, 0, "data")) {
            if (!isKnown)
                throw Error(where, std::string("its WAV header has no format; ") + accepted);
            return header;
        }
        std::size_t rest = number(head, 4, 4);
        rest += rest % 2;
        std::vector<std::byte> content(std::min(rest, largestFormatBytes));
        for (; rest > 0; rest -= content.size()) {
            content.resize(std::min(rest, content.size()));
            fetch(content);
            if (isTag(head, 0, "fmt ") && !isKnown) {
                header = headerOf(content, where);
                isKnown = true;
            }
        }
    }
    throw Error(where, std::string("has no samples in its first thousand chunks; ") + accepted);
}

std::vector<std::byte> expand24(std::span<const std::byte> bytes)
{
    std::vector<std::byte> wide;
    wide.reserve(bytes.size() / 3 * 4);
    for (std::size_t at = 0; at + 3 <= bytes.size(); at += 3) {
        wide.push_back(std::byte(0));
        wide.insert(wide.end(), bytes.begin() + std::ptrdiff_t(at), bytes.begin() + std::ptrdiff_t(at) + 3);
    }
    return wide;
}

} // namespace faintline
