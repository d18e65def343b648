#pragma once

#include "frames/NormalisedFrames.h"

namespace faintline {

/// Noise bandwidth of a bin, in resolution cells 1/T_FT: N·Σw²/(Σw)², which is 1 for a rectangular and 1.5 for a Hann
/// window.
double noiseBandwidthCells(WindowShape shape);

/// The change of an event's SNR, which is that in a bin of these frames whatever window found it, to that against the
/// noise in `hz`, dB: B = noiseBandwidthCells/T_FT is a bin's noise bandwidth,
///
///   SNR(hz) = SNR(bin)·B/hz
///
/// WSPR and the modes of WSJT-X refer to 2500 Hz.
double snrChangeDb(double hz, const FrameGeometry &geometry);

} // namespace faintline
