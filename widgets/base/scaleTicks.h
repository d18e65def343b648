#pragma once

#include "widgets/base/Span.h"

#include <qwt_scale_div.h>

namespace faintline {

/// Ticks at round times: 1, 2, 5 · 10ⁿ s, then 10, 15, 30 s, 1, 2, 5, 10, 15, 30 min, 1, 2, 3, 6, 12 h, days. Rounding
/// refers to seconds from 0 of the scale, or to `origin` plus these if 0 is itself a time.
QwtScaleDiv timeScaleDiv(const Span &span, int majorTicks, double origin = 0.0);

/// Ticks at 1, 2, 5 · 10ⁿ, counted from `origin` below the scale's 0.
QwtScaleDiv linearScaleDiv(const Span &span, int majorTicks, double origin = 0.0);

/// On a logarithmic scale: ticks at 1, 2, 5 · 10ⁿ, or 1, 3 · 10ⁿ, or 10ⁿ where these are more than `majorTicks`; those
/// of a linear scale where fewer than three lie in the span.
QwtScaleDiv logarithmicScaleDiv(const Span &span, int majorTicks);

/// For exponents of 10: ticks at integers, or every second, third … if there are more than `most`.
QwtScaleDiv decadeScaleDiv(const Span &exponents, int most);

/// For exponents of 10: ticks at all integers, and at 2 … 9 times their powers.
QwtScaleDiv digitScaleDiv(const Span &exponents);

/// Distance between a scale's major ticks.
double majorStep(const QwtScaleDiv &div);

} // namespace faintline
