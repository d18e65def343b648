#pragma once

#include "base/FramePlane.h"
#include "frames/PeakPyramid.h"

#include <memory>

namespace faintline {

/// Two-dimensional cuts of pictures of frames on several axes (a sonar's range and bearing), for display only. They
/// merge frames where the original picture has merged them.

/// One axis against time: the maximum over the other axes, with the cells of that axis.
std::shared_ptr<const PeakPyramid> pictureAlong(const PeakPyramid &picture, const Grid &grid, std::size_t axis);

/// A plane of the frame of that number, with its axis `along` in place of time: the maxima over hidden axes that are
/// not cut. Precondition: the grid has both axes of the plane.
std::shared_ptr<const PeakPyramid> pictureOfFrame(const PeakPyramid &picture, const Grid &grid, Index frame,
                                                  const FramePlane &plane = {});

/// The cell with the largest value behind a place of that picture.
Index strongestCell(const PeakPyramid &picture, const Grid &grid, Index frame, const FramePlane &plane, Index row,
                    Index column);

/// Values of rows × columns as a picture, with `rows` in place of time.
std::shared_ptr<const PeakPyramid> pictureOf(const Axis &rows, const Axis &columns, std::span<const float> values,
                                             ByteScale scale);

} // namespace faintline
