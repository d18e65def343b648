#pragma once

#include <filesystem>

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

} // namespace faintline
