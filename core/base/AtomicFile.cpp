#include "base/AtomicFile.h"

#include "base/Error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <unistd.h>

namespace faintline {

namespace {

    std::string systemMessage(int code)
    {
        return std::strerror(code);
    }

    /// The file a name stands for: through links, so that they stay links.
    std::string target(const std::string &path)
    {
        namespace fs = std::filesystem;
        if (path.empty())
            throw Error("a file to write", "has no name");
        std::error_code code;
        const fs::file_status status = fs::status(path, code);
        if (!fs::exists(status))
            return path;
        if (fs::is_directory(status))
            throw Error(path, "is a folder; give the name of a file");
        if (!fs::is_regular_file(status)) // renaming over a device would replace it
            throw Error(path, "is not a regular file, so it cannot be replaced in one step");
        const fs::path resolved = fs::canonical(path, code);
        return code ? path : resolved.string();
    }

} // namespace

AtomicFile::AtomicFile(const std::string &path) : m_path(target(path))
{
    for (int attempt = 0; m_descriptor < 0; ++attempt) {
        m_temporaryPath = m_path + "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".part";
        m_descriptor = ::open(m_temporaryPath.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (m_descriptor < 0 && (errno != EEXIST || attempt > 1000))
            throw Error(path, "cannot be written: " + systemMessage(errno));
    }
}

AtomicFile::~AtomicFile()
{
    if (m_descriptor < 0)
        return;
    ::close(m_descriptor);
    ::unlink(m_temporaryPath.c_str());
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(m_descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            throw Error(m_path, "cannot be written: " + systemMessage(errno), Error::Kind::Failure);
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
}

void AtomicFile::commit()
{
    const int descriptor = m_descriptor;
    m_descriptor = -1;
    const bool closed = ::close(descriptor) == 0; // network file systems report a full disk here
    if (!closed || ::rename(m_temporaryPath.c_str(), m_path.c_str()) != 0) {
        const int code = errno;
        ::unlink(m_temporaryPath.c_str());
        throw Error(m_path, "cannot be written: " + systemMessage(code), Error::Kind::Failure);
    }
}

void writeTextFile(const std::string &path, std::string_view text)
{
    AtomicFile file(path);
    file.write(text);
    file.commit();
}

} // namespace faintline
