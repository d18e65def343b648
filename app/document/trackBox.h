#pragma once

#include "widgets/base/Viewport.h"

namespace faintline {

struct Analysis;
struct Track;

/// The box of time and the last axis that a track's path fills. Precondition: at least one point.
Viewport::Box trackBox(const Track &track, const Analysis &analysis);

} // namespace faintline
