#include "live/sources/PipeSource.h"

#include "base/Error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace faintline {

namespace {

    constexpr std::size_t readBytes = std::size_t(1) << 16; ///< capacity of a pipe
    constexpr std::ptrdiff_t nothingYet = -1;

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

} // namespace faintline
