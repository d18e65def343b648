#include "base/files/InputFiles.h"

#include "base/Error.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <optional>

#include <sys/stat.h>

namespace faintline {

namespace {

    using FileIdentity = std::pair<unsigned long long, unsigned long long>;

    /// Of a regular file: writing to the pipe or terminal that is read destroys nothing.
    std::optional<FileIdentity> identityOf(const std::string &path)
    {
        struct stat status = {};
        if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode))
            return std::nullopt;
        return FileIdentity(status.st_dev, status.st_ino);
    }

    /// Without links. The file need not exist yet.
    std::string realPathOf(const std::string &path)
    {
        namespace fs = std::filesystem;
        constexpr int mostLinks = 40;
        std::error_code failure;
        fs::path real = fs::absolute(path, failure);
        for (int links = 0; links < mostLinks && fs::is_symlink(real, failure); ++links)
            real = real.parent_path() / fs::read_symlink(real, failure);
        real = fs::weakly_canonical(real, failure);
        return failure ? path : real.string();
    }

    struct AllInputFiles {
        std::mutex mutex;
        std::vector<const InputFiles *> lists;
    };

    AllInputFiles &allInputFiles()
    {
        static AllInputFiles all;
        return all;
    }

} // namespace

bool isSameFile(const std::string &one, const std::string &other)
{
    const auto identity = identityOf(one);
    return (identity && identity == identityOf(other)) || realPathOf(one) == realPathOf(other);
}

InputFiles::InputFiles(const std::vector<std::string> &paths)
{
    for (const std::string &path : paths)
        if (const auto identity = identityOf(path)) {
            m_identities.insert(*identity);
            m_paths.insert(realPathOf(path));
        }
    const std::scoped_lock lock(allInputFiles().mutex);
    allInputFiles().lists.push_back(this);
}

InputFiles::~InputFiles()
{
    const std::scoped_lock lock(allInputFiles().mutex);
    std::erase(allInputFiles().lists, this);
}

bool InputFiles::holds(const std::string &path) const
{
    const auto identity = identityOf(path);
    return identity && (m_identities.contains(*identity) || m_paths.contains(realPathOf(path)));
}

void InputFiles::refuse(const std::string &path)
{
    const std::scoped_lock lock(allInputFiles().mutex);
    const auto &lists = allInputFiles().lists;
    if (std::any_of(lists.begin(), lists.end(), [&](const InputFiles *list) { return list->holds(path); }))
        throw Error(path, "is an input and would be replaced; give the output another name");
}

} // namespace faintline
