#include "evaluate/theory/boxExceedance.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace faintline {

namespace {

    constexpr Index mostCells = 2'000'000;
    constexpr std::int64_t pointMinimumCells = 10; ///< cells above a level that is worth a point

} // namespace

std::vector<ExceedancePoint> boxExceedance(const PeakPyramid &statistic, Index beginFrame, Index endFrame,
                                           Index beginCell, Index endCell)
{
    beginFrame = std::clamp<Index>(beginFrame, 0, statistic.frameCount());
    endFrame = std::clamp<Index>(endFrame, beginFrame, statistic.frameCount());
    beginCell = std::clamp<Index>(beginCell, 0, statistic.cells());
    endCell = std::clamp<Index>(endCell, beginCell, statistic.cells());
    const Index width = endCell - beginCell;
    std::vector<ExceedancePoint> points;
    if (statistic.framesPerRow(0) != 1 || width == 0 || beginFrame == endFrame)
        return points;
    const Index stride = std::max<Index>(1, (endFrame - beginFrame) * width / mostCells);
    std::array<std::int64_t, 256> counts{};
    std::int64_t total = 0;
    for (Index frame = beginFrame; frame < endFrame; frame += stride) {
        const auto row = statistic.row(0, frame);
        for (const std::uint8_t byte : row.subspan(std::size_t(beginCell), std::size_t(width)))
            ++counts[byte];
        total += width;
    }
    // Half the way to the next byte's value lies what rounding takes for it.
    std::int64_t above = total;
    for (int byte = 0; byte < 255; ++byte) {
        above -= counts[std::size_t(byte)];
        if (above < pointMinimumCells)
            break;
        points.push_back(
            {0.5 * (statistic.scale().value(byte) + statistic.scale().value(byte + 1)), double(above) / double(total)});
    }
    return points;
}

} // namespace faintline
