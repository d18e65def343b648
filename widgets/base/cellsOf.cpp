#include "widgets/base/cellsOf.h"

namespace faintline {

std::pair<Index, Index> cellsOf(const Axis &axis, const Span &span)
{
    Axis bounded = axis;
    bounded.cyclic = false;
    return {bounded.nearest(span.low), bounded.nearest(span.high) + 1};
}

} // namespace faintline
