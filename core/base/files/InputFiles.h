#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace faintline {

/// Whether two names are those of one file, which need not exist yet: under any spelling and through links.
bool isSameFile(const std::string &one, const std::string &other);

/// Files that are read while this object exists. No result replaces one of them: AtomicFile refuses to, under any
/// spelling of the name and through symbolic and hard links, because files are compared by device and inode.
class InputFiles
{
public:
    /// Names of no regular file are ignored.
    explicit InputFiles(const std::vector<std::string> &paths);
    ~InputFiles();
    InputFiles(const InputFiles &) = delete;
    InputFiles &operator=(const InputFiles &) = delete;

    /// Throws Error if a result written to `path` would replace a file that is read.
    static void refuse(const std::string &path);

private:
    bool holds(const std::string &path) const;

    std::set<std::pair<unsigned long long, unsigned long long>> m_identities; ///< device and inode
    std::set<std::string> m_paths; ///< resolved; a file written anew in the meantime has another inode
};

} // namespace faintline
