#pragma once

#include "frames/PeakPyramid.h"
#include "widgets/base/Viewport.h"

#include <optional>

namespace faintline {

/// Centre of the strongest cell of a picture whose centre lies in a box; the first of equal ones. Nothing if the box
/// contains none.
std::optional<Viewport::Point> peakNear(const PeakPyramid &picture, const Axis &frequency, const Viewport::Box &box);

} // namespace faintline
