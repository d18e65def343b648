#pragma once

#include "spectrum/NoiseBackground.h"
#include "spectrum/Spectrogram.h"

#include <vector>

namespace faintline {

/// Correction of a background near steep edges of the noise, for each bin of the spectrogram: ln of the median over
/// time of y/B over that of noise; 0 elsewhere, and empty if nothing is steep or the recording has fewer than 1024
/// windows.
///
/// ln B is interpolated linearly between cells. Where noise falls by 60 dB within a few cells, ln B is curved, so that
/// the true value half a cell away is 1 to 2 dB higher, and a running median over frequency rounds the corners. Both
/// errors persist like a line. Within six cells of a fall of 5 dB between adjacent cells, the bins themselves are
/// therefore measured in 1024 frames over the whole recording, which gives a bin's noise to 5 %. At most 2 dB are
/// corrected: a line that exceeds an edge by more remains.
std::vector<float> edgeCorrection(const Spectrogram &spectrogram, const NoiseBackground &background);

} // namespace faintline
