#include "calibrate/CalibrationStore.h"

#include "base/files/AtomicFile.h"
#include "base/files/checksum.h"
#include "base/json.h"
#include "plan/calibrationVersion.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

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

    Json ratesToJson(const RareRates &rates)
    {
        return {{"levels", rates.levels}, {"lnRates", rates.lnRates}, {"relativeErrors", rates.relativeErrors}};
    }

    RareRates ratesFromJson(const Json &json)
    {
        return {json.at("levels").get<std::vector<double>>(), json.at("lnRates").get<std::vector<double>>(),
                json.at("relativeErrors").get<std::vector<double>>()};
    }

    /// Whole numbers without a decimal point.
    Json countsToJson(const std::vector<double> &counts)
    {
        Json json = Json::array();
        for (const double count : counts)
            if (count == std::floor(count) && std::abs(count) < 1e15)
                json.push_back(std::int64_t(count));
            else
                json.push_back(count);
        return json;
    }

    Json toJson(const Calibration &c)
    {
        return {{"isFirstEstimate", c.isFirstEstimate},
                {"lnK", c.lnK},
                {"continuedFraction", c.continuedFraction},
                {"anchorNats", c.anchorNats},
                {"eventRate", c.eventRate},
                {"tailSlope", c.tailSlope},
                {"relativeError", c.relativeError},
                {"slopeError", c.slopeError},
                {"rates", ratesToJson(c.rates)},
                {"excursions", ratesToJson(c.excursions)},
                {"lowestLevel", c.lowestLevel},
                {"levelStep", c.levelStep},
                {"cells", c.cells},
                {"above", countsToJson(c.above)}};
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
        c.rates = ratesFromJson(json.at("rates"));
        c.excursions = ratesFromJson(json.at("excursions"));
        json.at("lowestLevel").get_to(c.lowestLevel);
        json.at("levelStep").get_to(c.levelStep);
        json.at("cells").get_to(c.cells);
        json.at("above").get_to(c.above);
        return c;
    }

    /// Content of a calibration file, without its checksum.
    Json contentOf(const std::string &key, const Calibration &calibration)
    {
        return {{"version", calibrationVersion}, {"key", key}, {"calibration", toJson(calibration)}};
    }

    bool areUsable(const RareRates &rates)
    {
        return rates.levels.size() == rates.lnRates.size() && rates.levels.size() == rates.relativeErrors.size()
               && rates.levels.size() != 1 && std::is_sorted(rates.levels.begin(), rates.levels.end());
    }

    bool isUsable(const Calibration &c)
    {
        return c.levelCount() >= 2 && c.level(1) > c.level(0) && std::isfinite(c.level(c.levelCount())) && c.cells > 0.0
               && c.tailSlope > 0.0 && c.eventRate > 0.0 && areUsable(c.rates) && areUsable(c.excursions);
    }

    /// As far as it is of this program's version.
    std::shared_ptr<const Calibration> shipped(const std::string &key)
    {
        for (const ShippedCalibration &candidate : shippedCalibrations())
            if (candidate.key == key)
                return CalibrationStore::fromText(candidate.text, key);
        return nullptr;
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
    if (auto calibration = shipped(key))
        return calibration;
    if (m_folder.empty())
        return nullptr;
    const fs::path file = fileFor(key);
    std::error_code code;
    if (!fs::is_regular_file(file, code) || fs::file_size(file, code) > largestFileBytes)
        return nullptr;
    std::ifstream stream(file, std::ios::binary);
    return fromText(std::string(std::istreambuf_iterator<char>(stream), {}), key);
}

std::shared_ptr<const Calibration> CalibrationStore::fromText(std::string_view text, const std::string &key)
{
    try {
        const Json json = parseJson(text, "a calibration");
        if (json.at("version") != calibrationVersion || json.at("key") != key)
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

std::string CalibrationStore::toText(const std::string &key, const Calibration &calibration)
{
    Json json = contentOf(key, calibration);
    json["checksum"] = checksum(json.dump());
    return json.dump();
}

void CalibrationStore::save(const std::string &key, const Calibration &calibration) const
{
    if (m_folder.empty())
        return;
    std::error_code code;
    fs::create_directories(m_folder, code);
    try {
        writeTextFile(fileFor(key).string(), toText(key, calibration),
                      Durability::Program); // a file damaged by a crash is made again
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
    lock.emplace(lockFileFor(key));
    return lock->isHeld();
}

fs::path CalibrationStore::lockFileFor(const std::string &key) const
{
    return m_folder / ("making-" + checksum(key));
}

fs::file_time_type CalibrationStore::lastSign(const std::string &key) const
{
    std::error_code code;
    const fs::file_time_type time = fs::last_write_time(lockFileFor(key), code);
    return code ? fs::file_time_type{} : time;
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

CalibrationLock::CalibrationLock(std::filesystem::path file) : m_file(std::move(file))
{
    for (int tries = 0; tries < 100; ++tries) {
        m_descriptor = ::open(m_file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0666);
        m_isHeld = m_descriptor < 0 || ::flock(m_descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
        struct stat status = {};
        const bool wasRemoved =
            m_descriptor >= 0 && m_isHeld && ::fstat(m_descriptor, &status) == 0 && status.st_nlink == 0;
        if (!wasRemoved) // by the previous holder
            return;
        ::close(m_descriptor);
        m_descriptor = -1;
    }
}

void CalibrationLock::giveSign() const
{
    if (m_descriptor >= 0 && m_isHeld)
        ::futimens(m_descriptor, nullptr);
}

CalibrationLock::~CalibrationLock()
{
    if (m_descriptor < 0)
        return;
    if (m_isHeld)
        ::unlink(m_file.c_str());
    ::close(m_descriptor);
}

} // namespace faintline
