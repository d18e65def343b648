#include "widgets/base/diskRoom.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QStorageInfo>

#include <cmath>

namespace faintline {

std::optional<double> freeBytes(const QString &folder)
{
    QString there = QDir::cleanPath(QDir(folder).absolutePath());
    while (!QFileInfo::exists(there) && !QDir(there).isRoot())
        there = QFileInfo(there).path();
    const QStorageInfo disk(there);
    return disk.isValid() ? std::optional(double(disk.bytesAvailable())) : std::nullopt;
}

QString roughTimeText(double seconds)
{
    constexpr double minute = 60.0, hour = 3600.0, day = 86400.0;
    const auto tr = [](const char *text) { return QCoreApplication::translate("diskRoom", text); };
    if (seconds >= 3.0 * day)
        return tr("%1 days").arg(std::floor(seconds / day));
    if (seconds >= 2.0 * hour)
        return tr("%1 h").arg(std::floor(seconds / hour));
    return tr("%1 min").arg(std::floor(seconds / minute));
}

} // namespace faintline
