#pragma once

#include "frames/PeakPyramid.h"
#include "widgets/base/Span.h"
#include "widgets/plot/ColourMap.h"

#include <array>
#include <optional>

namespace faintline {

/// The colours of a picture's bytes.
struct PictureColours {
    const ColourMap *map = &ColourMap::named(ColourMap::defaultName());
    Span range{-6.0, 14.0};            ///< values of the first and last colour
    std::optional<double> threshold{}; ///< of a statistic, whose colours follow it
    std::optional<double> contour{};   ///< pixels adjacent to values at or above this one have the contour's colour
    QRgb contourColour = 0xffffffff;

    std::array<QRgb, 256> table(const ByteScale &scale) const;
    int contourByte(const ByteScale &scale) const { return contour ? scale.byte(*contour) : 256; }

    bool operator==(const PictureColours &) const = default;
};

} // namespace faintline
