#pragma once

#include "base/Axis.h"

#include <cstddef>
#include <span>
#include <string>

namespace faintline {

/// Random access to the bytes of a regular file, of any size.
///
/// Reads at positions through one descriptor, so it may be used from several threads at once, survives the file being
/// renamed, and a file that shrinks meanwhile gives short reads, not a crash.
class FileBytes
{
public:
    /// Throws Error where there is no such file, it is a folder or a device, or it may not be read.
    explicit FileBytes(const std::string &path);
    ~FileBytes();
    FileBytes(const FileBytes &) = delete;
    FileBytes &operator=(const FileBytes &) = delete;

    const std::string &path() const { return m_path; }

    /// In bytes, when it was opened.
    Index size() const { return m_size; }

    /// Reads from `offset` on; returns how many bytes were there, fewer than wanted only at the end of the file.
    /// Throws Error where the device fails.
    std::size_t readAt(Index offset, std::span<std::byte> out) const;

private:
    std::string m_path;
    int m_descriptor = -1;
    Index m_size = 0;
};

} // namespace faintline
