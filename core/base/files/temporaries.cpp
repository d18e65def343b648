#include "base/files/temporaries.h"

#include <filesystem>
#include <mutex>
#include <set>

namespace faintline {

namespace {

    struct KnownPaths {
        std::mutex guard;
        std::set<std::string> paths;
    };

    /// Never destroyed: threads may end after main.
    KnownPaths &known()
    {
        static auto *all = new KnownPaths;
        return *all;
    }

} // namespace

void makeTemporary(const std::function<std::string()> &make)
{
    const std::lock_guard lock(known().guard);
    if (const std::string path = make(); !path.empty())
        known().paths.insert(path);
}

void forgetTemporary(const std::string &path)
{
    const std::lock_guard lock(known().guard);
    known().paths.erase(path);
}

void removeTemporaries()
{
    known().guard.lock(); // never unlocked
    for (const std::string &path : known().paths) {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
}

} // namespace faintline
