#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "noise/pings/PingNoise.h"

#include <string>

namespace faintline {

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
