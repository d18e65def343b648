#pragma once

#include <filesystem>

namespace faintline {

/// Held by the one program, of those that share a folder, that makes a calibration; the others may wait for it rather
/// than make the same. Gone with the object, or with the program however it ends. Where nothing can be locked, or the
/// file goes again and again, it counts as held.
class CalibrationLock
{
public:
    /// Tries, and does not wait. `file` is there only as long as somebody holds it.
    explicit CalibrationLock(std::filesystem::path file);
    ~CalibrationLock();
    CalibrationLock(const CalibrationLock &) = delete;
    CalibrationLock &operator=(const CalibrationLock &) = delete;

    bool isHeld() const { return m_isHeld; }

private:
    std::filesystem::path m_file;
    int m_descriptor = -1;
    bool m_isHeld = false;
};

} // namespace faintline
