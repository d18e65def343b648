#include "widgets/waterfall/peakNear.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faintline {

std::optional<Viewport::Point> peakNear(const PeakPyramid &picture, const Axis &frequency, const Viewport::Box &box)
{
    std::array<double, 256> values;
    for (std::size_t byte = 0; byte < values.size(); ++byte)
        values[byte] = picture.scale().value(int(byte));
    const auto framesPerRow = double(picture.framesPerRow(0));
    const auto rowMiddle = [&](Index row) { return (double(row) + 0.5) * framesPerRow - 0.5; };
    const auto within = [](double low, double high, Index count) {
        return std::pair(std::max<Index>(Index(std::ceil(low - 1e-9)), 0),
                         std::min(Index(std::floor(high + 1e-9)) + 1, count));
    };
    const auto rowOf = [&](double seconds) { return (picture.time().position(seconds) + 0.5) / framesPerRow - 0.5; };
    const auto [firstRow, endRow] = within(rowOf(box.time.low), rowOf(box.time.high), picture.rowCount(0));
    const auto [firstCell, endCell] =
        within(frequency.position(box.frequency.low), frequency.position(box.frequency.high), frequency.count);

    std::optional<Viewport::Point> best;
    double highest = 0.0;
    for (Index row = firstRow; row < endRow; ++row) {
        const auto bytes = picture.row(0, row);
        for (Index cell = firstCell; cell < endCell; ++cell) {
            const double value = values[static_cast<unsigned char>(bytes[std::size_t(cell)])];
            if (best && value <= highest)
                continue;
            highest = value;
            best = Viewport::Point{picture.time().value(rowMiddle(row)), frequency.value(double(cell))};
        }
    }
    return best;
}

} // namespace faintline
