#include "calibrate/CalibrationLock.h"

#include <cerrno>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace faintline {

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
