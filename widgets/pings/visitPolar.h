#pragma once

#include "base/Axis.h"
#include "widgets/base/Span.h"

#include <QSize>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

/// Visits the pixels of a canvas seen from above that lie beyond the near side of a range axis and on its bearings
/// (degrees): visit(pixel, distance from the near side in the range's unit, beam). `x` points east, `y` north; rows of
/// pixels go southward.
template <class Visit>
void visitPolar(const Span &x, const Span &y, const QSize &size, const Axis &range, const Axis &bearing, Visit visit)
{
    const double nearSide = range.value(-0.5);
    const double low = bearing.value(-0.5);
    const double turn = bearing.step * double(bearing.count);
    std::size_t pixel = 0;
    for (int row = 0; row < size.height(); ++row) {
        const double north = y.high - (row + 0.5) * y.width() / size.height();
        for (int column = 0; column < size.width(); ++column, ++pixel) {
            const double east = x.low + (column + 0.5) * x.width() / size.width();
            const double distance = std::hypot(east, north) - nearSide;
            if (distance < 0.0)
                continue;
            double angle = std::atan2(east, north) * 180.0 / std::numbers::pi;
            angle -= 360.0 * std::floor((angle - low) / 360.0);
            if (angle - low < turn)
                visit(pixel, distance, std::min<Index>(Index((angle - low) / bearing.step), bearing.count - 1));
        }
    }
}

} // namespace faintline
