#pragma once

#include "base/Axis.h"
#include "widgets/base/quantities.h"

namespace faintline {

/// Text of axes: frequencies in Hz, kHz or MHz, other quantities in their own unit.

/// The unit of an axis's labels, and the divisor of its values.
FrequencyUnit shownUnit(const Axis &axis);

/// "Frequency (kHz)", "Bearing (deg)"; only the name if there is no unit.
QString titleOf(const Axis &axis);

/// "12.4 m", in the axis's own unit.
QString valueText(const Axis &axis, double value, double resolution);

} // namespace faintline
