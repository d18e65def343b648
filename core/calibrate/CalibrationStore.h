#pragma once

#include "plan/Calibration.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace faintline {

/// Lock that lets one of several programs that share a folder make a calibration while others wait for it. Released
/// with the object, or when the program ends in any way. If nothing can be locked, or the file disappears repeatedly,
/// it counts as held.
class CalibrationLock
{
public:
    /// Tries to lock without waiting. `file` exists only while a program holds it.
    explicit CalibrationLock(std::filesystem::path file);
    ~CalibrationLock();
    CalibrationLock(const CalibrationLock &) = delete;
    CalibrationLock &operator=(const CalibrationLock &) = delete;

    bool isHeld() const { return m_isHeld; }

    /// Tells who waits that this program is at work: sets the file's time. Cheap, thread-safe.
    void giveSign() const;

private:
    std::filesystem::path m_file;
    int m_descriptor = -1;
    bool m_isHeld = false;
};

/// Calibrations stored on disk between runs of the program: one JSON file per key in one folder.
///
/// Storing changes no result: numbers are written in the form that reads back the same, and a file is used only if its
/// checksum is correct and it was written for the same key by a program with the same `calibrationVersion`. Any other
/// file (unreadable, truncated, changed, foreign) is ignored, and nothing is stored in a folder that is not writable;
/// neither is an error. Calibrations shipped with the program are found before the files of the folder. The oldest files
/// are removed when there are more than `largestFileCount`. Files appear only when complete, so any number of programs
/// may share a folder.
class CalibrationStore
{
public:
    static constexpr std::size_t largestFileCount = 200;

    /// Stores files in a folder, which is created when first needed; an empty path stores nothing.
    explicit CalibrationStore(std::filesystem::path folder) : m_folder(std::move(folder)) {}

    /// The user's cache folder: FAINTLINE_CACHE (a folder, or `off`), else $XDG_CACHE_HOME/faintline, else
    /// ~/.cache/faintline.
    static std::filesystem::path usualFolder();

    /// From now on the program stores its calibrations in another folder, which starts as a copy of the usual one.
    static void moveTo(const std::filesystem::path &folder);

    /// The calibration stored under a key, or null.
    std::shared_ptr<const Calibration> load(const std::string &key) const;

    void save(const std::string &key, const Calibration &calibration) const;

    /// Tries to become the program, among those that share the folder, that makes a key's calibration. Returns true on
    /// success or if nothing is stored.
    bool lock(std::optional<CalibrationLock> &lock, const std::string &key) const;

    /// When the program that holds a key's lock last gave a sign of life; the beginning of time if none holds it.
    std::filesystem::file_time_type lastSign(const std::string &key) const;

    /// Content of a file, and the calibration in it: null if it is not whole, or of another key or version.
    static std::string toText(const std::string &key, const Calibration &calibration);
    static std::shared_ptr<const Calibration> fromText(std::string_view text, const std::string &key);

    /// File in which a key's calibration is stored.
    std::filesystem::path fileFor(const std::string &key) const;

private:
    std::filesystem::path lockFileFor(const std::string &key) const;
    void removeOldest() const;

    std::filesystem::path m_folder;
};

/// A calibration that is part of the program: a file of resources/calibrations.
struct ShippedCalibration {
    std::string_view name; ///< of the file, without ending
    std::string_view key;
    std::string_view text; ///< as a CalibrationStore writes it
};

/// All of them, in the order of their names.
std::span<const ShippedCalibration> shippedCalibrations();

} // namespace faintline
