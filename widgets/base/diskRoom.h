#pragma once

#include <QString>

#include <optional>

namespace faintline {

/// Free bytes of the disk that a folder is on, or will be on when it is made; none where that is unknown.
std::optional<double> freeBytes(const QString &folder);

/// How long it takes to fill them, roughly: "42 h", "12 min".
QString roughTimeText(double seconds);

} // namespace faintline
