#pragma once

#include "live/SampleSource.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace faintline {

/// Where a datagram has its number, counted from one to the next: in so many bytes at its beginning.
struct SequenceNumbers {
    int bytes = 0; ///< 0: datagrams are not numbered
    bool isBigEndian = false;
};

/// "u16be", "u32le" …; empty: none. Throws Error.
SequenceNumbers parseSequenceNumbers(std::string_view name);

/// Bare samples in UDP datagrams, whole ones in each.
///
/// Where datagrams are numbered, the samples of those that are missing are lost at their place; a datagram that comes
/// later than its successor stays lost, and one that is more than an hour ahead is of a sender that began anew.
/// Otherwise only what this machine drops is known, by the datagram. After a second of silence the sender is gone; when
/// it is back, the gap is as long as its numbers say, if the clock agrees within a quarter of a second, else as the
/// clock says.
class UdpSource final : public SampleSource
{
public:
    /// `address`: "PORT", on all of this machine's addresses, or "ADDRESS:PORT". Throws Error.
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
    std::uint32_t m_dropped = 0;             ///< datagrams, as the kernel counts
    std::optional<Clock::time_point> m_last; ///< when one came
    bool m_isGone = false;
    bool m_isLate = false; ///< the datagram just read belongs before what was heard
    Heard m_next;          ///< what was read behind a loss
    std::vector<std::byte> m_datagram;
};

} // namespace faintline
