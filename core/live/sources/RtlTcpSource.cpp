#include "live/sources/RtlTcpSource.h"

#include "base/Error.h"
#include "signal/formats/bytes.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <thread>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace faintline {

namespace {

    constexpr std::size_t receivedBytes = std::size_t(1) << 17;
    constexpr std::chrono::seconds askingInterval{1};
    constexpr std::chrono::milliseconds firstPatience{3000};
    constexpr std::chrono::milliseconds laterPatience{150}; ///< used twice; delays a stop request by as much

    /// Fills the whole span, or returns false.
    bool readWhole(int socket, std::span<std::byte> bytes, std::chrono::milliseconds patience)
    {
        while (!bytes.empty()) {
            pollfd wanted{socket, POLLIN, 0};
            if (::poll(&wanted, 1, int(patience.count())) <= 0)
                return false;
            const ssize_t count = ::recv(socket, bytes.data(), bytes.size(), MSG_DONTWAIT);
            if (count <= 0)
                return false;
            bytes = bytes.subspan(std::size_t(count));
        }
        return true;
    }

} // namespace

RtlTcpSource::RtlTcpSource(const std::string &address, const ReceiverSettings &settings)
    : m_address(parseHostAndPort(address, "1234")), m_settings(settings)
{
    m_format.type = parseSampleType("cu8", "rtl_tcp");
    m_format.sampleRateHz = settings.sampleRateHz;
    m_format.centreHz = settings.frequencyHz;
    m_format.origin = "rtl_tcp " + address;
    std::string reason;
    if (!connect(firstPatience, reason))
        throw Error("--rtl-tcp " + address, "no receiver answers: " + reason);
}

RtlTcpSource::~RtlTcpSource()
{
    if (m_socket >= 0)
        ::close(m_socket);
}

bool RtlTcpSource::connect(std::chrono::milliseconds patience, std::string &reason)
{
    m_asked = Clock::now();
    m_socket = connectTcp(m_address, patience, reason);
    if (m_socket < 0)
        return false;
    std::array<std::byte, 12> greeting{}; // "RTL0", tuner type, number of gains
    const bool isRtl = readWhole(m_socket, greeting, patience) && asText(greeting).starts_with("RTL0");
    if (isRtl && sendAll())
        return true;
    reason = isRtl ? "it takes no commands" : "it does not identify itself as rtl_tcp";
    ::close(std::exchange(m_socket, -1));
    return false;
}

bool RtlTcpSource::sendAll() const
{
    const auto whole = [](double value) { return std::uint32_t(std::llround(value)); };
    return send(2, whole(m_settings.sampleRateHz)) && send(5, std::uint32_t(m_settings.correctionPpm))
           && send(1, whole(m_settings.frequencyHz)) && send(3, m_settings.gainDb ? 1 : 0)
           && (!m_settings.gainDb || send(4, whole(10.0 * *m_settings.gainDb)));
}

bool RtlTcpSource::send(std::uint8_t command, std::uint32_t value) const
{
    std::array<std::uint8_t, 5> bytes{command};
    for (std::size_t i = 1; i < bytes.size(); ++i)
        bytes[i] = std::uint8_t(value >> (32 - 8 * i));
    return ::send(m_socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) == std::ssize(bytes);
}

Heard RtlTcpSource::lose(const std::string &why)
{
    ::close(std::exchange(m_socket, -1));
    m_rest.clear();
    Heard heard;
    if (!std::exchange(m_isBack, false)) { // otherwise already reported
        heard.incident = Heard::Incident::Gone;
        heard.words = "The receiver is gone: " + why + ".";
    }
    return heard;
}

Heard RtlTcpSource::hear(std::chrono::milliseconds patience)
{
    if (m_socket < 0) {
        std::string ignored;
        if (Clock::now() - m_asked < askingInterval || !connect(laterPatience, ignored))
            std::this_thread::sleep_for(patience);
        else
            m_isBack = true;
        return {};
    }
    pollfd wanted{m_socket, POLLIN, 0};
    if (::poll(&wanted, 1, int(patience.count())) <= 0)
        return {};
    std::vector<std::byte> bytes = std::move(m_rest);
    m_rest.clear();
    const std::size_t before = bytes.size();
    bytes.resize(before + receivedBytes);
    const ssize_t count = ::recv(m_socket, bytes.data() + before, receivedBytes, MSG_DONTWAIT);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
        bytes.resize(before);
        m_rest = std::move(bytes);
        return {};
    }
    if (count <= 0)
        return lose(count == 0 ? "the connection was closed" : std::strerror(errno));
    bytes.resize(before + std::size_t(count));
    const std::size_t whole = bytes.size() / 2 * 2;
    m_rest.assign(bytes.begin() + std::ptrdiff_t(whole), bytes.end());
    bytes.resize(whole);
    Heard heard;
    const auto samples = Index(whole / 2);
    if (std::exchange(m_isBack, false) && m_last) {
        const double elapsed = std::chrono::duration<double>(Clock::now() - *m_last).count();
        heard.lostSamples = std::max<Index>(0, std::llround(elapsed * m_format.sampleRateHz) - samples);
        heard.incident = Heard::Incident::Back;
        heard.words = "The receiver is back.";
    }
    m_last = Clock::now();
    heard.bytes = std::move(bytes);
    return heard;
}

} // namespace faintline
