#pragma once

#include <QStringList>

namespace faintline {

/// The files' names as labels show them, in the order given; where two files have one name, with the folders that tell
/// them apart: "night.wav (2024/site 3)".
QStringList distinctLabels(const QStringList &paths);

/// The same of one file that stands among others.
QString distinctLabel(const QString &path, const QStringList &others);

} // namespace faintline
