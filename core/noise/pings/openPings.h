#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "noise/pings/PingNoise.h"
#include "signal/RawPings.h"

#include <memory>
#include <string>

namespace faintline {

/// Opens a stack of frames on several axes, as numbers: .npy (NumPyPings), or HDF5 with a dataset "pings" (Hdf5Pings).
/// Null for other files, also for frames on a single axis. `gridPath`: empty for axes without units. Reads headers
/// only. Throws Error naming the file and the cause.
std::shared_ptr<const RawPings> openRawPings(const std::string &path, const std::string &gridPath);

/// How to take a stack that says nothing of its numbers.
enum class UnstatedPings {
    Guess,     ///< by guessPingValues
    Normalised ///< floats as normalised; others are guessed
};

/// Opens such a stack if it has to be normalised, and normalises it; null for stacks that are normalised already, and
/// for other files. What its numbers are is taken from `settings.values`, otherwise from the grid. Throws Error,
/// Cancelled.
NormalisedFramesPointer openPings(const std::string &path, const std::string &gridPath,
                                  const PingNoiseSettings &settings = {}, UnstatedPings unstated = UnstatedPings::Guess,
                                  const RunContext &context = {});

} // namespace faintline
