#include "exchange/survey/findRecordings.h"

#include "base/Error.h"
#include "base/files/fileName.h"
#include "signal/fileFormats.h"
#include "signal/formats/SampleType.h"
#include "signal/formats/SigmfRecording.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>

namespace faintline {

namespace fs = std::filesystem;

namespace {

    bool isRecording(const std::string &path, bool raw)
    {
        if (raw)
            return rawTypeOfExtension(path).has_value();
        if (hasEnding(path, ".npy"))
            return fs::exists(gridPathOf(path));
        return isNamedLikeRecording(path);
    }

    std::string absoluteName(const fs::path &path)
    {
        return fs::absolute(path).lexically_normal().string();
    }

    struct Search {
        bool raw;
        std::set<std::string> &found;
        std::vector<std::string> &unreadable;

        void folder(const fs::path &path)
        {
            std::error_code code;
            fs::directory_iterator entry(path, code);
            for (const fs::directory_iterator end; !code && entry != end; entry.increment(code))
                take(*entry);
            if (code)
                unreadable.push_back(path.string());
        }

        void take(const fs::directory_entry &entry)
        {
            std::error_code code;
            if (entry.path().filename().native().starts_with('.'))
                return;
            if (entry.is_directory(code) && !entry.is_symlink(code))
                folder(entry.path());
            else if (entry.is_regular_file(code) && isRecording(entry.path().native(), raw))
                found.insert(absoluteName(entry.path()));
        }
    };

} // namespace

std::vector<std::string> findRecordings(const std::vector<std::string> &names, bool raw,
                                        std::vector<std::string> &unreadable)
{
    std::set<std::string> found;
    Search search{raw, found, unreadable};
    for (const std::string &name : names) {
        std::error_code code;
        const fs::file_status status = fs::status(name, code);
        if (!fs::exists(status))
            throw Error(name, "there is no such file or folder");
        if (fs::is_directory(status))
            search.folder(absoluteName(name));
        else if (!fs::is_regular_file(status)) // opening a pipe would block
            throw Error(name, "is neither a file nor a folder");
        else
            found.insert(absoluteName(!raw && SigmfRecording::isNamedSo(name) ? SigmfRecording::metaPath(name) : name));
    }
    return {found.begin(), found.end()};
}

} // namespace faintline
