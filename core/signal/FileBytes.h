#pragma once

#include "base/Axis.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace faintline {

/// Random access to the bytes of a regular file, of any size.
///
/// Reads at given positions through one descriptor. It may be used from several threads at once and survives renaming
/// of the file; a file that shrinks gives short reads, not a crash.
class FileBytes
{
public:
    /// Throws Error if the file does not exist, is a folder or a device, or is not readable.
    explicit FileBytes(const std::string &path);
    ~FileBytes();
    FileBytes(const FileBytes &) = delete;
    FileBytes &operator=(const FileBytes &) = delete;

    const std::string &path() const { return m_path; }

    /// Size in bytes when the file was opened.
    Index size() const { return m_size; }

    /// Reads from `offset` on; returns the number of bytes read, fewer than requested only at the end of the file.
    /// Throws Error if the device fails.
    std::size_t readAt(Index offset, std::span<std::byte> out) const;
    /// Whether it holds these bytes at an offset.
    bool hasAt(Index offset, std::string_view bytes) const;

private:
    std::string m_path;
    int m_descriptor = -1;
    Index m_size = 0;
};

} // namespace faintline
