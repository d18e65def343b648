#pragma once

#include "live/sources/SampleSource.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace faintline {

/// Sequence number of a datagram: its first `bytes` bytes, incremented by one per datagram.
struct SequenceNumbers {
    int bytes = 0; ///< 0: datagrams are not numbered
    bool isBigEndian = false;
};

/// "u16be", "u32le" …; empty: none. Throws Error.
SequenceNumbers parseSequenceNumbers(std::string_view name);

/// Raw samples in UDP datagrams, each holding whole samples.
///
/// With sequence numbers, missing datagrams become gaps at their position; one that arrives after its successor stays
/// lost, and one more than an hour ahead means that the sender restarted. Without numbers, only datagrams dropped by
/// this machine are known. After one second of silence the sender is considered gone. On return the gap follows from
/// the sequence numbers if the clock agrees within 0.25 s, otherwise from the clock.
class UdpSource final : public SampleSource
{
public:
    /// `address`: "PORT", on all addresses of this machine, or "ADDRESS:PORT". Throws Error.
    UdpSource(const std::string &address, const StreamFormat &format, SequenceNumbers numbers = {});
    ~UdpSource() override;
    UdpSource(const UdpSource &) = delete;
    UdpSource &operator=(const UdpSource &) = delete;

    const StreamFormat &format() const override { return m_format; }
    Heard hear(std::chrono::milliseconds patience) override;

private:
    using Clock = std::chrono::steady_clock;

    bool receive(Heard &heard);
    Index lostBefore(std::uint64_t number, Index samples);
    void noteSilence(Heard &heard);

    StreamFormat m_format;
    SequenceNumbers m_numbers;
    int m_socket = -1;
    std::optional<std::uint64_t> m_expected; ///< number of the next datagram
    std::uint32_t m_dropped = 0;             ///< datagrams, as counted by the kernel
    std::optional<Clock::time_point> m_last; ///< arrival of the last datagram
    bool m_isGone = false;
    bool m_isLate = false; ///< the last datagram arrived after its successor
    Heard m_next;          ///< data read after a loss
    std::vector<std::byte> m_datagram;
};

} // namespace faintline
