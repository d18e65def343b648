#pragma once

#include "base/Axis.h"
#include "widgets/base/quantities.h"

namespace faintline {

/// How an axis of cells is written: frequencies in Hz, kHz or MHz, everything else in its own unit.

/// The unit an axis is labelled in, and what its values are divided by for that.
FrequencyUnit shownUnit(const Axis &axis);

/// "Frequency (kHz)", "Bearing (deg)"; without a unit the name alone.
QString titleOf(const Axis &axis);

/// "12.4 m", in the axis's own unit.
QString valueText(const Axis &axis, double value, double resolution);

} // namespace faintline
