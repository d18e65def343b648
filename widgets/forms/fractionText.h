#pragma once

#include "base/Field.h"

#include <QString>

namespace faintline {

/// A value as displayed in forms: as in files, except that thirds, sevenths and the like are fractions, "1/3, 1/3". It
/// reads back as the same value (parseFieldValue).
QString fractionText(const FieldValue &value);

} // namespace faintline
