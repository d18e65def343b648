#pragma once

#include "base/RunContext.h"
#include "spectrum/NoiseNormaliser.h"
#include "spectrum/NormalisedFrames.h"
#include "spectrum/PowerFrames.h"
#include "spectrum/Spectrogram.h"

#include <memory>
#include <string>

namespace faintline {

/// Where the axes of a stack of frames are described: beside it, NAME.grid.json for NAME.npy.
std::string gridPathOf(const std::string &stackPath);

/// Whether a file has time and frequency (or any other axes) in it already, so that it is frames and no recording: a
/// NumPy file by its name, the others of openPower by content. False where there is no such file.
bool holdsFrames(const std::string &path);

/// A file of power that is not normalised yet; null where it is of another kind. Reads no more than headers.
///
///   sigproc filterbank   .fil of 1, 2, 4, 8, 16, 32 bits (SigprocFile)
///   HDF5 filterbank      .h5 (Hdf5Filterbank)
///   NumPy spectrogram    .npy of shape (frames, frequencies) whose NAME.grid.json says "values": "power" (NumPyPower)
///
/// Throws Error naming the file and what is wrong with it.
std::shared_ptr<const PowerFrames> openPower(const std::string &path);

/// Which part of a file of power is normalised, and how.
struct FramesOptions {
    SelectionSettings selection; ///< channel (polarisation), time and band
    NormaliserSettings noise;
};

/// The frames of such a file; null where it is of another kind, a recording.
///
///   .npy     normalised power of shape (frames, cells…), with axes from NAME.grid.json where that is there; the
///            options do not matter, unless it is power
///   others   power, over its noise (NormalisedPower)
///
/// Throws Error, Cancelled.
NormalisedFramesPointer openFrames(const std::string &path, const FramesOptions &options = {},
                                   const RunContext &context = {});

} // namespace faintline
