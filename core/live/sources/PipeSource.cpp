#include "live/sources/PipeSource.h"

#include "base/Error.h"
#include "signal/formats/bytes.h"
#include "signal/formats/riffChunks.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <string_view>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace faintline {

namespace {

    constexpr std::size_t readBytes = std::size_t(1) << 16; ///< capacity of a pipe
    constexpr std::ptrdiff_t nothingYet = -1;

    constexpr std::size_t largestFormatBytes = 4096;
    constexpr int mostChunks = 1000;
    constexpr const char *accepted =
        "give a WAV file, or say what the samples are (such as --raw-type ci16_le --raw-rate 48000)";

    std::uint32_t number(std::span<const std::byte> bytes, std::size_t at, std::size_t count)
    {
        return std::uint32_t(littleEndian(bytes.subspan(at, count)));
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

PipeSource::PipeSource(const std::string &path, const std::optional<StreamFormat> &raw, const std::stop_token &stop)
    : m_path(path == "-" ? "standard input" : path), m_isOwned(path != "-")
{
    // Open a FIFO before it has a writer.
    m_descriptor = m_isOwned ? ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC) : STDIN_FILENO;
    if (m_descriptor < 0)
        throw Error(m_path, std::string("cannot be opened: ") + std::strerror(errno));
    if (raw) {
        m_format = *raw;
        m_format.origin = m_path;
        return;
    }
    try {
        const WavHeader header = readWavHeader(
            [&](std::span<std::byte> bytes) {
                while (!bytes.empty()) {
                    const std::ptrdiff_t count = readSome(bytes, std::chrono::milliseconds(50));
                    if (count == 0)
                        return false;
                    if (stop.stop_requested())
                        throw Cancelled();
                    bytes = bytes.subspan(std::size_t(std::max<std::ptrdiff_t>(0, count)));
                }
                return true;
            },
            m_path);
        m_format = header.format;
        m_format.origin = m_path + ", WAV";
        m_isPacked24 = header.isPacked24;
        m_samples.emplace(header);
    } catch (...) {
        if (m_isOwned)
            ::close(m_descriptor);
        throw;
    }
}

PipeSource::~PipeSource()
{
    if (m_isOwned)
        ::close(m_descriptor);
}

/// Reads the bytes available; 0: end of the stream.
std::ptrdiff_t PipeSource::readSome(std::span<std::byte> bytes, std::chrono::milliseconds patience)
{
    pollfd wanted{m_descriptor, POLLIN, 0};
    if (::poll(&wanted, 1, int(patience.count())) <= 0)
        return nothingYet;
    const ssize_t count = ::read(m_descriptor, bytes.data(), bytes.size());
    if (count < 0 && (errno == EAGAIN || errno == EINTR))
        return nothingYet;
    if (count < 0)
        throw Error(m_path, std::string("cannot be read: ") + std::strerror(errno), Error::Kind::Failure);
    return count;
}

Heard PipeSource::hear(std::chrono::milliseconds patience)
{
    Heard heard;
    const std::size_t sampleBytes = std::size_t(m_isPacked24 ? 3 * m_format.channelCount : m_format.frameBytes());
    std::vector<std::byte> got(readBytes);
    const std::ptrdiff_t count = readSome(got, patience);
    heard.isOver = count == 0;
    got.resize(std::size_t(std::max<std::ptrdiff_t>(0, count)));
    if (m_samples)
        got = m_samples->take(std::move(got), heard.isOver);
    std::vector<std::byte> bytes = std::move(m_rest);
    bytes.insert(bytes.end(), got.begin(), got.end());
    const auto whole = std::ptrdiff_t(bytes.size() / sampleBytes * sampleBytes);
    m_rest.assign(bytes.begin() + whole, bytes.end());
    bytes.resize(std::size_t(whole));
    heard.bytes = m_isPacked24 ? expand24(bytes) : std::move(bytes);
    return heard;
}

WavHeader readWavHeader(const std::function<bool(std::span<std::byte>)> &read, const std::string &where)
{
    const auto fetch = [&](std::span<std::byte> bytes) {
        if (!read(bytes))
            throw Error(where, std::string("ended within its header; ") + accepted);
    };
    std::array<std::byte, riffHeadBytes> riff{};
    fetch(riff);
    if (!(asText(riff).starts_with("RIFF") || asText(riff).starts_with("RF64")) || !asText(riff).ends_with("WAVE"))
        throw Error(where, std::string("does not begin as a WAV file; ") + accepted);
    const bool isRf64 = asText(riff).starts_with("RF64");
    Index longDataBytes = 0;
    WavHeader header;
    bool isKnown = false;
    for (int chunk = 0; chunk < mostChunks; ++chunk) {
        std::array<std::byte, chunkHeadBytes> head{};
        fetch(head);
        if (asText(head).starts_with("data")) {
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
            if (asText(head).starts_with("ds64") && content.size() >= 16)
                longDataBytes = Index(littleEndian(std::span(content).subspan(8, 8)) & ~(std::uint64_t(1) << 63));
            if (asText(head).starts_with("fmt ") && !isKnown) {
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
