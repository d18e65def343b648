#include "live/sources/sockets.h"

#include "base/Error.h"

#include <cerrno>
#include <charconv>
#include <cstring>
#include <memory>
#include <system_error>

#include <netdb.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace faintline {

namespace {

    using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

    /// Rejects port numbers beyond 65535, which the library would take modulo 65536.
    bool isPort(const std::string &text)
    {
        unsigned port = 0;
        const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), port);
        return end != text.data() + text.size() || (failure == std::errc() && port >= 1 && port <= 65535);
    }

    Addresses resolve(const HostAndPort &address, int type, int flags, std::string &reason)
    {
        if (!isPort(address.port)) {
            reason = "the port must lie in 1 … 65535";
            return {nullptr, &::freeaddrinfo};
        }
        addrinfo wanted = {};
        wanted.ai_family = AF_UNSPEC;
        wanted.ai_socktype = type;
        wanted.ai_flags = flags;
        addrinfo *found = nullptr;
        const int failure =
            ::getaddrinfo(address.host.empty() ? nullptr : address.host.c_str(), address.port.c_str(), &wanted, &found);
        if (failure != 0)
            reason = ::gai_strerror(failure);
        return {failure == 0 ? found : nullptr, &::freeaddrinfo};
    }

    bool isConnected(int socket, std::chrono::milliseconds patience)
    {
        pollfd wanted{socket, POLLOUT, 0};
        int failure = 0;
        socklen_t size = sizeof failure;
        if (::poll(&wanted, 1, int(patience.count())) <= 0)
            failure = ETIMEDOUT;
        else
            ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &failure, &size);
        errno = failure;
        return failure == 0;
    }

} // namespace

HostAndPort parseHostAndPort(const std::string &text, const std::string &port)
{
    const std::size_t colon = text.rfind(':');
    const std::size_t bracket = text.rfind(']');
    const bool hasPort = colon != std::string::npos && (bracket == std::string::npos || bracket < colon);
    HostAndPort result{hasPort ? text.substr(0, colon) : text, hasPort ? text.substr(colon + 1) : port};
    if (!hasPort && port.empty())
        result = {"", text};
    if (result.host.starts_with("[") && result.host.ends_with("]"))
        result.host = result.host.substr(1, result.host.size() - 2);
    return result;
}

int openUdp(const std::string &address)
{
    std::string reason = "no such address";
    const Addresses found = resolve(parseHostAndPort(address, ""), SOCK_DGRAM, AI_PASSIVE, reason);
    for (const addrinfo *each = found.get(); each; each = each->ai_next) {
        const int socket = ::socket(each->ai_family, SOCK_DGRAM | SOCK_CLOEXEC, each->ai_protocol);
        if (socket >= 0 && ::bind(socket, each->ai_addr, each->ai_addrlen) == 0)
            return socket;
        reason = std::strerror(errno);
        if (socket >= 0)
            ::close(socket);
    }
    throw Error("--udp " + address, "cannot be heard: " + reason + "; expected PORT or ADDRESS:PORT");
}

int connectTcp(const HostAndPort &address, std::chrono::milliseconds patience, std::string &reason)
{
    reason = "no such address";
    const Addresses found = resolve(address, SOCK_STREAM, 0, reason);
    for (const addrinfo *each = found.get(); each; each = each->ai_next) {
        const int socket = ::socket(each->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, each->ai_protocol);
        if (socket < 0)
            continue;
        if (::connect(socket, each->ai_addr, each->ai_addrlen) == 0
            || (errno == EINPROGRESS && isConnected(socket, patience)))
            return socket;
        reason = std::strerror(errno);
        ::close(socket);
    }
    return -1;
}

} // namespace faintline
