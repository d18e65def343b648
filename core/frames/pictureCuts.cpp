#include "frames/pictureCuts.h"

#include <algorithm>

namespace faintline {

namespace {

    /// Times of the rows of the finest level, each in the middle of its frames.
    Axis rowTime(const PeakPyramid &picture)
    {
        const auto frames = double(picture.framesPerRow(0));
        Axis time = picture.time();
        time.first = time.value(0.5 * (frames - 1.0));
        time.step *= frames;
        time.count = picture.rowCount(0);
        return time;
    }

    std::span<const std::uint8_t> rowOf(const PeakPyramid &picture, Index frame)
    {
        return picture.row(0, std::clamp<Index>(frame / picture.framesPerRow(0), 0, picture.rowCount(0) - 1));
    }

} // namespace

std::shared_ptr<const PeakPyramid> pictureAlong(const PeakPyramid &picture, const Grid &grid, std::size_t axis)
{
    const Index count = grid.axes[axis].count;
    const Index stride = grid.stride(axis);
    auto result = std::make_shared<PeakPyramid>(rowTime(picture), count, picture.scale());
    std::vector<std::uint8_t> merged(static_cast<std::size_t>(count));
    for (Index r = 0; r < picture.rowCount(0); ++r) {
        const std::span<const std::uint8_t> row = picture.row(0, r);
        std::fill(merged.begin(), merged.end(), std::uint8_t(0));
        for (Index begin = 0; begin < std::ssize(row); begin += stride) {
            std::uint8_t &highest = merged[std::size_t(begin / stride % count)];
            for (Index i = begin; i < begin + stride; ++i)
                highest = std::max(highest, row[std::size_t(i)]);
        }
        result->appendBytes(merged);
    }
    result->finish();
    return result;
}

std::shared_ptr<const PeakPyramid> pictureOfFrame(const PeakPyramid &picture, const Grid &grid, Index frame,
                                                  const FramePlane &plane)
{
    const std::span<const std::uint8_t> values = rowOf(picture, frame);
    const CellsBehind cells(grid, plane);
    auto result = std::make_shared<PeakPyramid>(grid.axes[plane.along], cells.columns(), picture.scale());
    std::vector<std::uint8_t> line(std::size_t(cells.columns()));
    for (Index row = 0; row < cells.rows(); ++row) {
        for (Index column = 0; column < cells.columns(); ++column)
            line[std::size_t(column)] = values[std::size_t(cells.largest(values, row, column))];
        result->appendBytes(line);
    }
    result->finish();
    return result;
}

Index strongestCell(const PeakPyramid &picture, const Grid &grid, Index frame, const FramePlane &plane, Index row,
                    Index column)
{
    return CellsBehind(grid, plane).largest(rowOf(picture, frame), row, column);
}

std::shared_ptr<const PeakPyramid> pictureOf(const Axis &rows, const Axis &columns, std::span<const float> values,
                                             ByteScale scale)
{
    auto result = std::make_shared<PeakPyramid>(rows, columns.count, std::move(scale));
    result->append(values);
    result->finish();
    return result;
}

} // namespace faintline
