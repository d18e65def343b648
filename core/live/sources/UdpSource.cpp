#include "live/sources/UdpSource.h"

#include "base/Error.h"
#include "live/sources/sockets.h"
#include "signal/formats/bytes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace faintline {

namespace {

    constexpr std::size_t largestDatagram = 65536;
    constexpr std::size_t mostAtOnce = std::size_t(1) << 18;
    constexpr int receiveBytes = 8 << 20;
    constexpr std::chrono::seconds udpSilence{1};
    constexpr double clockSeconds = 0.25; ///< tolerance between clock and sequence numbers
    constexpr std::uint64_t mostLate = 64;
    constexpr double longestLossSeconds = 3600.0; ///< without a pause

    double secondsSince(std::chrono::steady_clock::time_point time)
    {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - time).count();
    }

} // namespace

SequenceNumbers parseSequenceNumbers(std::string_view name)
{
    if (name.empty())
        return {};
    for (const int bits : {16, 32, 64})
        for (const bool isBigEndian : {false, true})
            if (name == 'u' + std::to_string(bits) + (isBigEndian ? "be" : "le"))
                return {bits / 8, isBigEndian};
    throw Error("sequence numbers " + std::string(name), "must be one of u16le, u16be, u32le, u32be, u64le, u64be");
}

UdpSource::UdpSource(const std::string &address, const StreamFormat &format, SequenceNumbers numbers)
    : m_format(format), m_numbers(numbers), m_datagram(largestDatagram)
{
    m_format.origin = "UDP " + address;
    m_socket = openUdp(address);
    const int yes = 1;
    ::setsockopt(m_socket, SOL_SOCKET, SO_RCVBUF, &receiveBytes, sizeof receiveBytes);
    ::setsockopt(m_socket, SOL_SOCKET, SO_RXQ_OVFL, &yes, sizeof yes);
}

UdpSource::~UdpSource()
{
    ::close(m_socket);
}

/// Number of samples missing before a datagram with this number; sets m_isLate if it arrives too late.
Index UdpSource::lostBefore(std::uint64_t number, Index samples)
{
    const std::uint64_t mask = m_numbers.bytes == 8 ? ~std::uint64_t(0) : (std::uint64_t(1) << 8 * m_numbers.bytes) - 1;
    const std::uint64_t expected = std::exchange(m_expected, (number + 1) & mask).value_or(number);
    const std::uint64_t ahead = (number - expected) & mask;
    const double elapsed = m_isGone && m_last ? secondsSince(*m_last) * m_format.sampleRateHz : 0.0;
    if (ahead <= mask / 2) {
        const double byNumbers = double(ahead) * double(samples);
        const double error = std::abs(byNumbers + double(samples) - elapsed);
        const double rate = m_format.sampleRateHz;
        if (m_isGone ? error < clockSeconds * rate : byNumbers <= longestLossSeconds * rate)
            return Index(byNumbers);
    } else if (!m_isGone && mask - ahead < mostLate) {
        m_isLate = true;
        m_expected = expected;
        return 0;
    }
    return m_isGone ? std::max<Index>(0, Index(std::llround(elapsed)) - samples) : 0; // the sender restarted
}

/// Receives one datagram; false if there is none, or if it must wait because of a loss before it.
bool UdpSource::receive(Heard &heard)
{
    alignas(cmsghdr) std::byte control[CMSG_SPACE(sizeof(std::uint32_t))];
    iovec buffer{m_datagram.data(), m_datagram.size()};
    msghdr message = {};
    message.msg_iov = &buffer;
    message.msg_iovlen = 1;
    message.msg_control = control;
    message.msg_controllen = sizeof control;
    const ssize_t count = ::recvmsg(m_socket, &message, MSG_DONTWAIT);
    if (count < 0)
        return false;
    std::uint32_t dropped = m_dropped;
    for (cmsghdr *each = CMSG_FIRSTHDR(&message); each; each = CMSG_NXTHDR(&message, each))
        if (each->cmsg_level == SOL_SOCKET && each->cmsg_type == SO_RXQ_OVFL)
            std::memcpy(&dropped, CMSG_DATA(each), sizeof dropped);
    const auto header = std::size_t(m_numbers.bytes);
    const auto bytes = std::span<const std::byte>(m_datagram).first(std::size_t(count));
    const Index samples = (Index(count) - m_numbers.bytes) / m_format.frameBytes();
    const std::uint32_t newlyDropped = dropped - std::exchange(m_dropped, dropped);
    if (samples < 1)
        return true;
    Index lost = 0;
    m_isLate = false;
    if (m_numbers.bytes > 0) {
        const auto number = m_numbers.isBigEndian ? bigEndian : littleEndian;
        lost = lostBefore(number(bytes.first(header)), samples);
    } else if (m_isGone) {
        lost = std::max<Index>(0, std::llround(secondsSince(*m_last) * m_format.sampleRateHz) - samples);
    } else {
        lost = Index(newlyDropped) * samples;
    }
    if (m_isLate)
        return true;
    const bool isBack = std::exchange(m_isGone, false);
    m_last = Clock::now();
    const auto content = bytes.subspan(header, std::size_t(samples * m_format.frameBytes()));
    if (lost == 0 && !isBack) {
        heard.bytes.insert(heard.bytes.end(), content.begin(), content.end());
        return true;
    }
    Heard next;
    next.bytes.assign(content.begin(), content.end());
    next.lostSamples = lost;
    next.incident = isBack ? Heard::Incident::Back : Heard::Incident::Lost;
    next.words = isBack ? "The sender is back." : std::to_string(lost) + " samples were lost in transit.";
    if (heard.bytes.empty()) {
        heard = std::move(next);
        return true;
    }
    m_next = std::move(next);
    return false;
}

void UdpSource::noteSilence(Heard &heard)
{
    if (m_isGone || !m_last || Clock::now() - *m_last < udpSilence)
        return;
    m_isGone = true;
    heard.incident = Heard::Incident::Gone;
    heard.words = "The sender is silent.";
}

Heard UdpSource::hear(std::chrono::milliseconds patience)
{
    Heard heard = std::exchange(m_next, {});
    pollfd wanted{m_socket, POLLIN, 0};
    const bool hasSome = !heard.bytes.empty();
    if (::poll(&wanted, 1, hasSome ? 0 : int(patience.count())) <= 0) {
        if (!hasSome)
            noteSilence(heard);
        return heard;
    }
    while (heard.bytes.size() < mostAtOnce && receive(heard)) {
    }
    return heard;
}

} // namespace faintline
