#pragma once

#include <QStringList>

namespace faintline {

/// Labels for file names, in the given order; files with the same name get the folders that distinguish them:
/// "night.wav (2024/site 3)".
QStringList distinctLabels(const QStringList &paths);

/// The same for one file among others.
QString distinctLabel(const QString &path, const QStringList &others);

} // namespace faintline
