#pragma once

#include "live/sources/SampleSource.h"
#include "live/sources/sockets.h"

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

namespace faintline {

/// Settings of an rtl_tcp receiver.
struct ReceiverSettings {
    double frequencyHz = 0.0;
    double sampleRateHz = 0.0;
    std::optional<double> gainDb; ///< none: automatic
    int correctionPpm = 0;
};

/// 8-bit I/Q from an rtl_tcp server, whose receiver is configured as requested.
///
/// Commands are five bytes, a number and a big-endian value: 1 frequency, 2 sample rate, 3 gain mode, 4 gain in tenths
/// of a decibel, 5 correction in ppm. If the server disconnects, the source tries to reconnect every second. rtl_tcp
/// does not count samples, so the length of the gap is measured by the clock. Source: rtl_tcp.c of librtlsdr.
class RtlTcpSource final : public SampleSource
{
public:
    /// `address`: "HOST" or "HOST:PORT", default port 1234. Throws Error if no rtl_tcp server answers.
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
    std::vector<std::byte> m_rest; ///< of an incomplete sample
    std::optional<Clock::time_point> m_last;
    Clock::time_point m_asked{};
    bool m_isBack = false; ///< reconnected, but no samples yet
};

} // namespace faintline
