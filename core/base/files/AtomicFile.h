#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// What a written file survives: a crash of the program, or a crash of the machine as well, which takes some
/// milliseconds.
enum class Durability { Program, Machine };

/// What a file is: a result, which never replaces a file that the program reads (InputFiles), or a document, such as a
/// session or a scene, which is read and written again.
enum class Written { Result, Document };

/// A file that appears under its name only when it is complete.
///
/// Bytes go to a temporary file in the same folder; `commit` renames it to the final name. Without a commit
/// (cancellation, an exception) the temporary file is removed and the existing file stays untouched. A temporary file
/// left by a killed program is removed by the next program that writes the same file. Throws Error if the folder is
/// missing or not writable, the disk is full, or a result would replace an input.
class AtomicFile
{
public:
    explicit AtomicFile(const std::string &path, Durability durability = Durability::Machine,
                        Written written = Written::Result);
    ~AtomicFile();
    AtomicFile(const AtomicFile &) = delete;
    AtomicFile &operator=(const AtomicFile &) = delete;

    /// File descriptor of the temporary file, valid until the commit.
    int descriptor() const { return m_descriptor; }
    /// Name of the temporary file.
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

/// Defers the files that this thread commits: they are complete but do not appear until `commit` renames all of them in
/// the order of their commits. Without `commit` none appears. A result can thus never appear without its provenance,
/// which is committed before it.
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

/// Writes a whole text file, or nothing.
void writeTextFile(const std::string &path, std::string_view text, Durability durability = Durability::Machine,
                   Written written = Written::Result);

} // namespace faintline
