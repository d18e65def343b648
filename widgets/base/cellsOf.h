#pragma once

#include "base/Axis.h"
#include "widgets/base/Span.h"

#include <utility>

namespace faintline {

/// The whole cells of a span, at least one: first cell and one past the last. A span beside the axis gives the cells at
/// its ends, also for a cyclic axis.
std::pair<Index, Index> cellsOf(const Axis &axis, const Span &span);

} // namespace faintline
