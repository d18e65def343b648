#pragma once

#include "base/Grid.h"
#include "spectrum/PeakPyramid.h"

#include <memory>

namespace faintline {

/// Pictures of frames on two axes (a sonar's range and bearing), cut so that each is two-dimensional: for looking only,
/// like the pictures they are cut from. Where that one has merged frames, so have they.

/// One axis against time: the maximum over the other axes. Cells of the result: those of the axis.
std::shared_ptr<const PeakPyramid> pictureAlong(const PeakPyramid &picture, const Grid &grid, std::size_t axis);

/// The frame of that number, its first axis in the place of time, its second one across. Precondition: the grid has two
/// axes.
std::shared_ptr<const PeakPyramid> pictureOfFrame(const PeakPyramid &picture, const Grid &grid, Index frame);

/// Values of rows × columns as a picture, `rows` in the place of time.
std::shared_ptr<const PeakPyramid> pictureOf(const Axis &rows, const Axis &columns, std::span<const float> values,
                                             ByteScale scale);

} // namespace faintline
