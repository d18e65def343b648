#include "base/files/AtomicFile.h"

#include "base/Error.h"
#include "base/files/InputFiles.h"
#include "base/files/checksum.h"
#include "base/files/temporaries.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace faintline {

namespace {

    std::string systemMessage(int code)
    {
        return std::strerror(code);
    }

    /// Resolves links, so that they remain links.
    std::string target(const std::string &path)
    {
        namespace fs = std::filesystem;
        if (path.empty())
            throw Error("a file to write", "has no name");
        if (path.find('\0') != std::string::npos)
            throw Error(path, "is not a valid file name: it contains a zero byte");
        std::error_code code;
        const fs::file_status status = fs::status(path, code);
        if (!fs::exists(status))
            return path;
        if (fs::is_directory(status))
            throw Error(path, "is a folder; give the name of a file");
        if (!fs::is_regular_file(status)) // renaming over a device would replace it
            throw Error(path, "is not a regular file and cannot be replaced atomically");
        const fs::path resolved = fs::canonical(path, code);
        return code ? path : resolved.string();
    }

    thread_local CommitTogether *together = nullptr;

    /// Common prefix of a file's temporary files: its name, shortened to leave room for the suffix.
    std::string beginningOf(const std::string &path)
    {
        constexpr std::size_t longestNameBytes = 200;
        const std::size_t slash = path.rfind('/') + 1;
        const std::string name = path.substr(slash);
        return path.substr(0, slash)
               + (name.size() <= longestNameBytes ? name
                                                  : name.substr(0, longestNameBytes - 17) + "~" + checksum(name));
    }

    /// "NAME.PID-N.part"
    bool isTemporaryOf(std::string_view name, std::string_view temporary)
    {
        if (!temporary.starts_with(name) || !temporary.substr(name.size()).starts_with('.')
            || !temporary.ends_with(".part"))
            return false;
        const std::string_view middle =
            temporary.substr(name.size() + 1, temporary.size() - name.size() - std::string_view("..part").size());
        return middle.find('-') != std::string_view::npos
               && middle.find_first_not_of("0123456789-") == std::string_view::npos;
    }

    /// A writer keeps its file locked; locks of a killed program are released.
    void removeAbandoned(const std::string &path)
    {
        namespace fs = std::filesystem;
        const fs::path target(beginningOf(path));
        const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
        std::error_code code;
        for (fs::directory_iterator entry(folder, code), end; !code && entry != end; entry.increment(code)) {
            if (!isTemporaryOf(target.filename().native(), entry->path().filename().native()))
                continue;
            const int descriptor = ::open(entry->path().c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
            if (descriptor < 0)
                continue;
            if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0)
                ::unlink(entry->path().c_str());
            ::close(descriptor);
        }
    }

    /// A rename is only durable once the folder is written. Ignored if the folder cannot be opened or does not support
    /// it.
    void syncFolder(const std::string &path)
    {
        namespace fs = std::filesystem;
        const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
        const int descriptor = ::open(folder.c_str(), O_RDONLY | O_CLOEXEC | O_DIRECTORY);
        if (descriptor < 0)
            return;
        ::fsync(descriptor);
        ::close(descriptor);
    }

} // namespace

AtomicFile::AtomicFile(const std::string &path, Durability durability, Written written)
    : m_path(target(path)), m_durability(durability)
{
    if (written == Written::Result)
        InputFiles::refuse(path);
    removeAbandoned(m_path);
    makeTemporary([&] {
        makeTemporaryFile(path);
        return m_temporaryPath;
    });
}

AtomicFile::AtomicFile(AtomicFile &&other) noexcept
    : m_path(std::move(other.m_path)), m_temporaryPath(std::move(other.m_temporaryPath)),
      m_durability(other.m_durability), m_descriptor(std::exchange(other.m_descriptor, -1))
{
    other.m_path = m_path; // still needed after the commit
}

void AtomicFile::makeTemporaryFile(const std::string &path)
{
    for (int attempt = 0; m_descriptor < 0; ++attempt) {
        m_temporaryPath =
            beginningOf(m_path) + "." + std::to_string(::getpid()) + "-" + std::to_string(attempt) + ".part";
        m_descriptor = ::open(m_temporaryPath.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (m_descriptor < 0 && (errno != EEXIST || attempt > 1000))
            throw Error(path, "cannot be written: " + systemMessage(errno));
        if (m_descriptor < 0)
            continue;
        const bool isLocked = ::flock(m_descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        struct stat status = {};
        if (!isLocked
            || (::fstat(m_descriptor, &status) == 0
                && status.st_nlink == 0)) { // removed as abandoned before it was locked
            ::close(m_descriptor);
            m_descriptor = -1;
        }
    }
}

AtomicFile::~AtomicFile()
{
    if (m_descriptor < 0)
        return;
    ::unlink(m_temporaryPath.c_str());
    ::close(m_descriptor);
    forgetTemporary(m_temporaryPath);
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
    while (!bytes.empty()) {
        const ssize_t written = ::write(m_descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            throw Error(m_path, "cannot be written: " + systemMessage(errno), Error::Kind::Failure);
        bytes = bytes.subspan(std::size_t(written));
    }
}

void AtomicFile::commit()
{
    if (m_durability == Durability::Machine && ::fsync(m_descriptor) != 0
        && errno != EINVAL) // a full disk may be reported here
        throw Error(m_path, "cannot be written: " + systemMessage(errno), Error::Kind::Failure);
    if (!together)
        return rename();
    together->m_files.push_back(std::unique_ptr<AtomicFile>(new AtomicFile(std::move(*this))));
}

void AtomicFile::rename()
{
    const int descriptor = std::exchange(m_descriptor, -1);
    const bool renamed = ::rename(m_temporaryPath.c_str(), m_path.c_str()) == 0;
    const int renaming = errno;
    const bool closed = ::close(descriptor) == 0; // network file systems report a full disk here
    if (!renamed || !closed) {
        const int code = renamed ? errno : renaming;
        if (!renamed)
            ::unlink(m_temporaryPath.c_str());
        forgetTemporary(m_temporaryPath);
        throw Error(m_path, "cannot be written: " + systemMessage(code), Error::Kind::Failure);
    }
    forgetTemporary(m_temporaryPath);
    if (m_durability == Durability::Machine)
        syncFolder(m_path);
}

CommitTogether::CommitTogether()
{
    together = this;
}

CommitTogether::~CommitTogether()
{
    together = nullptr;
}

void CommitTogether::commit()
{
    together = nullptr;
    for (const auto &file : m_files)
        file->rename();
    m_files.clear();
}

void writeTextFile(const std::string &path, std::string_view text, Durability durability, Written written)
{
    AtomicFile file(path, durability, written);
    file.write(text);
    file.commit();
}

} // namespace faintline
