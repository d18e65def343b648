#pragma once

#include <chrono>
#include <string>

namespace faintline {

/// The two parts of "HOST:PORT", "[ADDRESS]:PORT", or of a part alone.
struct HostAndPort {
    std::string host; ///< may be empty
    std::string port;
};
/// `port`: what it is where none is given; empty: it has to be given, and stands alone where no host is.
HostAndPort parseHostAndPort(const std::string &text, const std::string &port);

/// A UDP socket that hears a port of this machine. Throws Error.
int openUdp(const std::string &address);

/// A TCP connection, which does not block; -1, with the reason, where there is none within `patience`.
int connectTcp(const HostAndPort &address, std::chrono::milliseconds patience, std::string &reason);

} // namespace faintline
