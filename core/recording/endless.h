#pragma once

#include "base/Axis.h"

namespace faintline {

/// The sample count of a recording whose end is not known yet: its samples pass by, and are read in order and once.
inline constexpr Index endlessSamples = Index(1) << 50;

} // namespace faintline
