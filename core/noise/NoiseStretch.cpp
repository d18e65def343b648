#include "noise/NoiseStretch.h"

#include "base/fastmath.h"

#include <algorithm>

namespace faintline {

void readStretch(const NoiseStretch &stretch, std::span<const float> levels, std::span<float> ln)
{
    stretch.sources.addUp(levels, ln);
    for (std::size_t cell = 0; cell < ln.size(); ++cell)
        ln[cell] = std::max(stretch.floor, stretch.lnPower[cell] + fastLn(std::max(ln[cell], 1e-30f)));
}

} // namespace faintline
