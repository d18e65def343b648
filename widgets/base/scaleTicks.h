#pragma once

#include "widgets/base/Span.h"

#include <qwt_scale_div.h>

namespace faintline {

/// Ticks at round times: 1, 2, 5 · 10ⁿ s, then 10, 15, 30 s, 1, 2, 5, 10, 15, 30 min, 1, 2, 3, 6, 12 h, days.
QwtScaleDiv timeScaleDiv(const Span &span, int majorTicks);

/// Ticks at 1, 2, 5 · 10ⁿ.
QwtScaleDiv linearScaleDiv(const Span &span, int majorTicks);

/// Distance of a scale's major ticks.
double majorStep(const QwtScaleDiv &div);

} // namespace faintline
