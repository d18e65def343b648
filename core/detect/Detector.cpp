#include "detect/Detector.h"

namespace faintline {

void Detector::updateBlock(std::span<const float> y, std::span<float> statistic, Index cells)
{
    const auto size = std::size_t(cells);
    for (std::size_t done = 0; done < y.size(); done += size)
        update(y.subspan(done, size), statistic.subspan(done, size));
}

} // namespace faintline
