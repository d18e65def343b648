#pragma once

#include "spectrum/NormalisedFrames.h"

#include <string>

namespace faintline {

/// Where the axes of a stack of frames are described: beside it, NAME.grid.json for NAME.npy.
std::string gridPathOf(const std::string &stackPath);

/// The frames of a file that has time and frequency (or any other axes) in it already; null where it is of another kind, a recording.
///
///   .npy   normalised power of shape (frames, cells…), with axes from NAME.grid.json where that is there
///
/// Throws Error naming the file and what is wrong with it.
NormalisedFramesPointer openFrames(const std::string &path);

} // namespace faintline
