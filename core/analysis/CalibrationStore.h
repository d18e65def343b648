#pragma once

#include "analysis/Calibration.h"
#include "analysis/CalibrationLock.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace faintline {

/// Calibrations kept on disk from one run of the program to the next: a JSON file for each key in one folder.
///
/// Keeping changes no result: numbers are written in the form that reads back the same, and a file counts only if it
/// was written for the same key by a program made from the same sources of the core, and its checksum is right.
/// Anything else (unreadable, cut short, changed, foreign) is as if it were not there, and a folder that cannot be
/// written keeps nothing; neither is an error. The oldest files go when there are more than `largestFileCount`. Files
/// appear whole, so any number of programs may share a folder.
class CalibrationStore
{
public:
    static constexpr std::size_t largestFileCount = 200;

    /// Keeps files in a folder, which is made when first needed; an empty path keeps nothing.
    explicit CalibrationStore(std::filesystem::path folder) : m_folder(std::move(folder)) {}

    /// The folder the user wants: FAINTLINE_CACHE (a folder, or `off`), else $XDG_CACHE_HOME/faintline, else
    /// ~/.cache/faintline.
    static std::filesystem::path usualFolder();

    /// From now on the program keeps its calibrations in another folder, which begins as a copy of the usual one.
    static void moveTo(const std::filesystem::path &folder);

    /// What was kept under a key, or null.
    std::shared_ptr<const Calibration> load(const std::string &key) const;

    void save(const std::string &key, const Calibration &calibration) const;

    /// Tries to be the one, of those that share the folder, who makes a key's calibration. True where that is so, or
    /// where nothing is kept.
    bool lock(std::optional<CalibrationLock> &lock, const std::string &key) const;

    /// Where a key's calibration is kept.
    std::filesystem::path fileFor(const std::string &key) const;

private:
    void removeOldest() const;

    std::filesystem::path m_folder;
};

} // namespace faintline
