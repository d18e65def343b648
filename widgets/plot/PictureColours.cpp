#include "widgets/plot/PictureColours.h"

#include "widgets/base/ColourScale.h"

namespace faintline {

std::array<QRgb, 256> PictureColours::table(const ByteScale &scale) const
{
    const ColourScale colours = ColourScale::of(scale, threshold);
    std::array<QRgb, 256> table;
    for (int byte = 0; byte < 256; ++byte)
        table[std::size_t(byte)] = map->at(colours.share(scale.value(byte), range));
    return table;
}

} // namespace faintline
