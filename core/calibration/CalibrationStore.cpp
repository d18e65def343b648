#include "calibration/CalibrationStore.h"

#include "base/AtomicFile.h"
#include "base/checksum.h"
#include "base/json.h"
#include "calibration/sourceFingerprint.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace faintline {

namespace fs = std::filesystem;

namespace {

    constexpr std::string_view filePrefix = "calibration-";
    constexpr std::uintmax_t largestFileBytes = 4u << 20;

    bool isNamedSo(const fs::path &file)
    {
        return file.filename().string().starts_with(filePrefix);
    }

    std::string environment(const char *name)
    {
        const char *value = std::getenv(name);
        return value ? value : "";
    }

    Json toJson(const Calibration &c)
    {
        return {
            {"isFirstEstimate", c.isFirstEstimate},
            {"lnK", c.lnK},
            {"continuedFraction", c.continuedFraction},
            {"anchorNats", c.anchorNats},
            {"eventRate", c.eventRate},
            {"tailSlope", c.tailSlope},
            {"relativeError", c.relativeError},
            {"slopeError", c.slopeError},
            {"rates",
             {{"levels", c.rates.levels}, {"lnRates", c.rates.lnRates}, {"relativeErrors", c.rates.relativeErrors}}},
            {"levels", c.levels},
            {"exceedance", c.exceedance}};
    }

    /// Throws if a member is missing or of another kind.
    Calibration fromJson(const Json &json)
    {
        Calibration c;
        json.at("isFirstEstimate").get_to(c.isFirstEstimate);
        json.at("lnK").get_to(c.lnK);
        json.at("continuedFraction").get_to(c.continuedFraction);
        json.at("anchorNats").get_to(c.anchorNats);
        json.at("eventRate").get_to(c.eventRate);
        json.at("tailSlope").get_to(c.tailSlope);
        json.at("relativeError").get_to(c.relativeError);
        json.at("slopeError").get_to(c.slopeError);
        json.at("rates").at("levels").get_to(c.rates.levels);
        json.at("rates").at("lnRates").get_to(c.rates.lnRates);
        json.at("rates").at("relativeErrors").get_to(c.rates.relativeErrors);
        json.at("levels").get_to(c.levels);
        json.at("exceedance").get_to(c.exceedance);
        return c;
    }

    /// Content of a calibration file, without its checksum.
    Json contentOf(const std::string &key, const Calibration &calibration)
    {
        return {{"sources", sourceFingerprint()}, {"key", key}, {"calibration", toJson(calibration)}};
    }

    bool isUsable(const Calibration &c)
    {
        return c.levels.size() >= 2 && c.levels.size() == c.exceedance.size() && c.tailSlope > 0.0 && c.eventRate > 0.0
               && c.rates.levels.size() == c.rates.lnRates.size()
               && c.rates.levels.size() == c.rates.relativeErrors.size() && c.rates.levels.size() != 1
               && std::is_sorted(c.rates.levels.begin(), c.rates.levels.end());
    }

} // namespace

fs::path CalibrationStore::usualFolder()
{
    const std::string wanted = environment("FAINTLINE_CACHE");
    if (wanted == "off")
        return {};
    if (!wanted.empty())
        return wanted;
    if (const fs::path cache = environment("XDG_CACHE_HOME"); cache.is_absolute())
        return cache / "faintline";
    if (const fs::path home = environment("HOME"); home.is_absolute())
        return home / ".cache" / "faintline";
    return {};
}

void CalibrationStore::moveTo(const fs::path &folder)
{
    const fs::path usual = usualFolder();
    if (usual.empty())
        return;
    std::error_code ignored;
    fs::create_directory(folder, ignored);
    for (fs::directory_iterator entry(usual, ignored), end; entry != end; entry.increment(ignored))
        if (std::error_code code; entry->is_regular_file(code) && isNamedSo(entry->path()))
            fs::copy_file(entry->path(), folder / entry->path().filename(), code);
    ::setenv("FAINTLINE_CACHE", folder.c_str(), 1);
}

fs::path CalibrationStore::fileFor(const std::string &key) const
{
    return m_folder / (std::string(filePrefix) + checksum(key) + ".json");
}

std::shared_ptr<const Calibration> CalibrationStore::load(const std::string &key) const
{
    if (m_folder.empty())
        return nullptr;
    const fs::path file = fileFor(key);
    std::error_code code;
    if (!fs::is_regular_file(file, code) || fs::file_size(file, code) > largestFileBytes)
        return nullptr;
    try {
        const Json json = readJsonFile(file.string());
        if (json.at("sources") != sourceFingerprint() || json.at("key") != key)
            return nullptr;
        const Calibration calibration = fromJson(json.at("calibration"));
        const bool isWhole = json.at("checksum") == checksum(contentOf(key, calibration).dump());
        return isWhole && isUsable(calibration) ? std::make_shared<const Calibration>(calibration) : nullptr;
    } catch (const Error &) {
        return nullptr;
    } catch (const Json::exception &) {
        return nullptr;
    }
}

void CalibrationStore::save(const std::string &key, const Calibration &calibration) const
{
    if (m_folder.empty())
        return;
    std::error_code code;
    fs::create_directories(m_folder, code);
    try {
        Json json = contentOf(key, calibration);
        json["checksum"] = checksum(json.dump());
        writeTextFile(fileFor(key).string(), json.dump(), Durability::Program); // a file damaged by a crash is made
                                                                                // again
        removeOldest();
    } catch (const Error &) {
        // Then cached for the life of the program only.
    }
}

bool CalibrationStore::lock(std::optional<CalibrationLock> &lock, const std::string &key) const
{
    if (m_folder.empty())
        return true;
    std::error_code ignored;
    fs::create_directories(m_folder, ignored);
    lock.emplace(m_folder / ("making-" + checksum(key)));
    return lock->isHeld();
}

void CalibrationStore::removeOldest() const
{
    std::error_code code;
    std::vector<std::pair<fs::file_time_type, fs::path>> files;
    for (fs::directory_iterator entry(m_folder, code), end; entry != end; entry.increment(code))
        if (isNamedSo(entry->path()))
            files.emplace_back(entry->last_write_time(code), entry->path());
    if (files.size() <= largestFileCount)
        return;
    std::sort(files.begin(), files.end());
    for (std::size_t i = 0; i < files.size() - largestFileCount; ++i)
        fs::remove(files[i].second, code);
}

} // namespace faintline
