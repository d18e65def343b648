#pragma once

#include "base/RunContext.h"
#include "frames/NormalisedFrames.h"
#include "frames/Spectrogram.h"
#include "noise/NoiseNormaliser.h"
#include "noise/pings/PingNoise.h"
#include "signal/fileFormats.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace faintline {

/// Ready-made frames in double precision, cell by cell, stage by stage, checked as by readFrames.
struct DoubleFrames {
    std::vector<Index> shape; ///< stages, cells…
    std::vector<double> values;
};
DoubleFrames readDoubleFrames(const std::string &path);

/// Throws Error naming `where` if a value is negative or infinite.
void checkFrameValues(std::span<const float> values, const std::string &where);

/// Reads ready-made frames from a NumPy file of shape (frames, cells…); `grid` may be empty (axes without units).
/// Negative or infinite values are errors; NaN denotes a cell that was not observed.
NormalisedFramesPointer readFrames(const std::string &path, const std::string &gridPath);

/// The part of a power file to normalise, and how.
struct FramesOptions {
    SelectionSettings selection; ///< channel (polarisation), time and band
    NormaliserSettings noise;
    PingNoiseSettings pings{}; ///< of frames on several axes
};

/// Opens the frames of such a file; null for other files, which are recordings.
///
///   .npy     normalised power of shape (frames, cells…), with axes from NAME.grid.json if it exists; the
///            options do not apply
///   pings    frames on several axes (.npy, or HDF5 with a dataset "pings") that are not normalised (openPings)
///   others   power, normalised by its noise (NormalisedPower)
///
/// Throws Error, Cancelled.
NormalisedFramesPointer openFrames(const std::string &path, const FramesOptions &options = {},
                                   const RunContext &context = {});

/// The frames of a NumPy file with axes from a given grid file; empty: axes without units. Floats are normalised power
/// unless the grid says otherwise; other numbers are normalised as pings. Throws Error, Cancelled.
NormalisedFramesPointer openStack(const std::string &path, const std::string &gridPath,
                                  const PingNoiseSettings &pings = {}, const RunContext &context = {});

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
