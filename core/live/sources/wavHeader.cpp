#include "live/sources/wavHeader.h"

#include "base/Error.h"
#include "signal/formats/listChunk.h"

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

    /// Whether a length stands for an unknown one: programs that write to a pipe give the largest their numbers hold.
    bool isOfUnknownLength(Index dataBytes)
    {
        constexpr Index page = 0x1000; // room that some of them leave for the header
        return dataBytes == 0 || (dataBytes >= 0x80000000 - page && dataBytes < 0x80000000)
               || (dataBytes >= 0x100000000 - page && dataBytes <= 0xffffffff);
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
    const bool isRf64 = isTag(riff, 0, "RF64");
    Index longDataBytes = 0;
    WavHeader header;
    bool isKnown = false;
    for (int chunk = 0; chunk < mostChunks; ++chunk) {
        std::array<std::byte, 8> head{};
        fetch(head);
        if (isTag(head, 0, "data")) {
            if (!isKnown)
                throw Error(where, std::string("its WAV header has no format; ") + accepted);
            header.isRf64 = isRf64;
            header.dataBytes = isRf64 && number(head, 4, 4) == 0xffffffff ? longDataBytes : number(head, 4, 4);
            return header;
        }
        std::size_t rest = number(head, 4, 4);
        rest += rest % 2;
        std::vector<std::byte> content(std::min(rest, largestFormatBytes));
        for (; rest > 0; rest -= content.size()) {
            content.resize(std::min(rest, content.size()));
            fetch(content);
            if (isTag(head, 0, "ds64") && content.size() >= 16)
                longDataBytes = Index(number(content, 12, 4) & 0x7fffffff) << 32 | number(content, 8, 4);
            if (isTag(head, 0, "fmt ") && !isKnown) {
                header = headerOf(content, where);
                isKnown = true;
            }
        }
    }
    throw Error(where, std::string("has no samples in its first thousand chunks; ") + accepted);
}

WavSamples::WavSamples(const WavHeader &header)
    : m_left(header.dataBytes), m_isEndless(isOfUnknownLength(header.dataBytes)), m_isRf64(header.isRf64),
      m_isOdd(header.dataBytes % 2 != 0)
{
}

std::vector<std::byte> WavSamples::take(std::vector<std::byte> bytes, bool isOver)
{
    if (m_isEndless)
        return bytes;
    if (m_isBehind)
        return {};
    const auto inside = std::ptrdiff_t(std::min(m_left, std::ssize(bytes)));
    m_held.insert(m_held.end(), bytes.begin() + inside, bytes.end());
    bytes.resize(std::size_t(inside));
    m_left -= inside;
    const BehindSamples behind = m_left > 0 ? BehindSamples::Unknown : behindSamples(m_held, m_isOdd, isOver);
    if (behind == BehindSamples::Unknown)
        return bytes;
    if (behind != BehindSamples::Samples) {
        m_isBehind = true;
        return bytes;
    }
    // A length in 32 bits is that of the samples but for a multiple of 4 GiB.
    bytes.insert(bytes.end(), m_held.begin(), m_held.end());
    m_isEndless = m_isRf64;
    m_left = (Index(1) << 32) - std::ssize(m_held);
    m_held.clear();
    return bytes;
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
