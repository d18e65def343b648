#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// What a file that was written survives: a crash of the program only, or of the machine as well, which takes some
/// milliseconds.
enum class Durability { Program, Machine };

/// A file that appears under its name only when it is complete.
///
/// Bytes go to a temporary neighbour in the same folder; `commit` renames it over the wanted name. Without a commit
/// (cancelled, an exception) nothing is left behind and what stood there before is untouched; what a killed program
/// left is removed by the next that writes the same file. Throws Error where the folder is missing, may not be written,
/// or the disk is full.
class AtomicFile
{
public:
    explicit AtomicFile(const std::string &path, Durability durability = Durability::Machine);
    ~AtomicFile();
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /// Where the bytes go until the commit, for writers that want a descriptor.
    int descriptor() const { return m_descriptor; }
    /// The same for writers that want a name.
    const std::string &temporaryPath() const { return m_temporaryPath; }
    const std::string &path() const { return m_path; }

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    void commit();

private:
    friend class CommitTogether;

    AtomicFile(AtomicFile &&other) noexcept;
    void makeTemporaryFile(const std::string &path);
    void rename();

    std::string m_path;
    std::string m_temporaryPath;
    Durability m_durability;
    int m_descriptor = -1;
};

/// As long as one lives, files that this thread commits are complete but do not appear; `commit` lets all of them, in
/// that order, one right after the other. Without it none does. So that a result is never there without what tells how
/// it was made: that one is committed before it.
class CommitTogether
{
public:
    CommitTogether();
    ~CommitTogether();
    CommitTogether(const CommitTogether &) = delete;
    CommitTogether &operator=(const CommitTogether &) = delete;

    void commit();

private:
    friend class AtomicFile;

    std::vector<std::unique_ptr<AtomicFile>> m_files;
};

/// Writes a whole text under a name, or nothing.
void writeTextFile(const std::string &path, std::string_view text, Durability durability = Durability::Machine);

} // namespace faintline
