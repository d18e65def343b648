#pragma once

#include "base/Field.h"

#include <QString>

namespace faintline {

/// A value as a form shows it: as files write it, but thirds, sevenths and the like as fractions, "1/3, 1/3". It reads
/// back as the same value (parseFieldValue).
QString fractionText(const FieldValue &value);

} // namespace faintline
