#pragma once

#include "spectrum/PeakPyramid.h"
#include "widgets/base/Viewport.h"

#include <optional>

namespace faintline {

/// The middle of the strongest cell of a picture whose middle lies in a box; of equal ones the first. Nothing where the
/// box holds none.
std::optional<Viewport::Point> peakNear(const PeakPyramid &picture, const Axis &frequency, const Viewport::Box &box);

} // namespace faintline
