#pragma once

#include "base/Grid.h"
#include "spectrum/PeakPyramid.h"

#include <memory>

namespace faintline {

/// Two-dimensional cuts of pictures of frames on two axes (a sonar's range and bearing), for display only. They merge
/// frames where the original picture has merged them.

/// One axis against time: the maximum over the other axes, with the cells of that axis.
std::shared_ptr<const PeakPyramid> pictureAlong(const PeakPyramid &picture, const Grid &grid, std::size_t axis);

/// The frame of that number, with its first axis in place of time and its second one across. Precondition: the grid has
/// two axes.
std::shared_ptr<const PeakPyramid> pictureOfFrame(const PeakPyramid &picture, const Grid &grid, Index frame);

/// Values of rows × columns as a picture, with `rows` in place of time.
std::shared_ptr<const PeakPyramid> pictureOf(const Axis &rows, const Axis &columns, std::span<const float> values,
                                             ByteScale scale);

} // namespace faintline
