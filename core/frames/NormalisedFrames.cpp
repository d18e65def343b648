#include "frames/NormalisedFrames.h"

#include <algorithm>

namespace faintline {

void FrameArray::read(Index first, Index count, std::span<float> out) const
{
    const Index cells = grid().size();
    std::copy_n(m_values.begin() + first * cells, count * cells, out.begin());
}

} // namespace faintline
