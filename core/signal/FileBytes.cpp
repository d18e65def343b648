#include "signal/FileBytes.h"

#include "base/Error.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace faintline {

FileBytes::FileBytes(const std::string &path) : m_path(path)
{
    if (path.find('\0') != std::string::npos) // the system would stop there and open another file
        throw Error(path, "no such file; a file name cannot contain a zero byte");
    // Without O_NONBLOCK, opening a named pipe would wait for its writer.
    m_descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (m_descriptor < 0 && (errno == ENOENT || errno == ENOTDIR))
        throw Error(path, "no such file");
    if (m_descriptor < 0)
        throw Error(path, std::string("cannot be opened: ") + std::strerror(errno));
    struct stat status = {};
    const bool isKnown = ::fstat(m_descriptor, &status) == 0;
    if (isKnown && S_ISREG(status.st_mode)) {
        m_size = Index(status.st_size);
        return;
    }
    ::close(m_descriptor);
    if (isKnown && S_ISDIR(status.st_mode))
        throw Error(path, "is a folder; expected a recording file");
    throw Error(path, "is a device or a pipe; a recording must be a regular file because it is read in any order");
}

FileBytes::~FileBytes()
{
    ::close(m_descriptor);
}

std::size_t FileBytes::readAt(Index offset, std::span<std::byte> out) const
{
    std::size_t done = 0;
    while (done < out.size()) {
        const auto from = static_cast<off_t>(offset) + static_cast<off_t>(done);
        const ssize_t got = ::pread(m_descriptor, out.data() + done, out.size() - done, from);
        if (got < 0 && errno == EINTR)
            continue;
        if (got < 0)
            throw Error(m_path, std::string("cannot be read: ") + std::strerror(errno), Error::Kind::Failure);
        if (got == 0)
            break;
        done += std::size_t(got);
    }
    return done;
}

bool FileBytes::hasAt(Index offset, std::string_view bytes) const
{
    std::string there(bytes.size(), 0);
    return readAt(offset, std::as_writable_bytes(std::span(there))) == bytes.size() && there == bytes;
}

} // namespace faintline
