#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace faintline {

/// A file that appears under its name only when it is complete.
///
/// Bytes go to a temporary neighbour in the same folder; `commit` renames it over the wanted name. Without a commit
/// (cancelled, an exception) nothing is left behind and what stood there before is untouched. Throws Error where the
/// folder is missing, may not be written, or the disk is full.
class AtomicFile
{
public:
    explicit AtomicFile(const std::string &path);
    ~AtomicFile();
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /// Where the bytes go until the commit, for writers that want a descriptor.
    int descriptor() const { return m_descriptor; }
    const std::string &path() const { return m_path; }

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    void commit();

private:
    std::string m_path;
    std::string m_temporaryPath;
    int m_descriptor = -1;
};

/// Writes a whole text under a name, or nothing.
void writeTextFile(const std::string &path, std::string_view text);

} // namespace faintline
