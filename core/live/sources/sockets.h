#pragma once

#include <chrono>
#include <string>

namespace faintline {

/// The parts of "HOST:PORT" or "[ADDRESS]:PORT", or of one part alone.
struct HostAndPort {
    std::string host; ///< may be empty
    std::string port;
};
/// `port`: default port. If empty, a port is required and may be given without a host.
HostAndPort parseHostAndPort(const std::string &text, const std::string &port);

/// Opens a UDP socket on a local port. Throws Error.
int openUdp(const std::string &address);

/// Opens a non-blocking TCP connection; returns -1, with the reason, if it fails or takes longer than `patience`.
int connectTcp(const HostAndPort &address, std::chrono::milliseconds patience, std::string &reason);

} // namespace faintline
