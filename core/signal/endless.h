#pragma once

#include "base/Axis.h"

namespace faintline {

/// Sample count of a recording whose end is not known yet; its samples are read in order and once.
inline constexpr Index endlessSamples = Index(1) << 50;

} // namespace faintline
