#pragma once

#include "base/Axis.h"
#include "widgets/base/Span.h"

#include <utility>

namespace faintline {

/// The whole cells of a span, at least one: the first, and the one behind the last. Beside the axis they are those at
/// its ends, of a cyclic one too.
std::pair<Index, Index> cellsOf(const Axis &axis, const Span &span);

} // namespace faintline
