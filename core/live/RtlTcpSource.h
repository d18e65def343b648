#pragma once

#include "live/SampleSource.h"
#include "live/sockets.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace faintline {

/// What a receiver behind rtl_tcp is set to.
struct ReceiverSettings {
    double frequencyHz = 0.0;
    double sampleRateHz = 0.0;
    std::optional<double> gainDb; ///< none: automatic
    int correctionPpm = 0;
};

/// I/Q of eight bits from an rtl_tcp server, whose receiver is set as asked for.
///
/// Commands are five bytes, a number and a big-endian value: 1 frequency, 2 sample rate, 3 gain mode, 4 gain in tenths
/// of a decibel, 5 correction in ppm. A server that goes away is asked for again every second; the gap is as long as
/// the clock says, for rtl_tcp counts nothing. Source: rtl_tcp.c of librtlsdr.
class RtlTcpSource final : public SampleSource
{
public:
    /// `address`: "HOST" or "HOST:PORT", 1234 unless it is given. Throws Error where no such server answers.
    RtlTcpSource(const std::string &address, const ReceiverSettings &settings);
    ~RtlTcpSource() override;
    RtlTcpSource(const RtlTcpSource &) = delete;
    RtlTcpSource &operator=(const RtlTcpSource &) = delete;

    const StreamFormat &format() const override { return m_format; }
    Heard hear(std::chrono::milliseconds patience) override;

private:
    using Clock = std::chrono::steady_clock;

    bool connect(std::chrono::milliseconds patience, std::string &reason);
    bool sendAll() const;
    bool send(std::uint8_t command, std::uint32_t value) const;
    Heard lose(const std::string &why);

    HostAndPort m_address;
    ReceiverSettings m_settings;
    StreamFormat m_format;
    int m_socket = -1;
    std::vector<std::byte> m_rest; ///< of a sample
    std::optional<Clock::time_point> m_last;
    Clock::time_point m_asked{};
    bool m_isBack = false; ///< connected again, and nothing came yet
};

} // namespace faintline
