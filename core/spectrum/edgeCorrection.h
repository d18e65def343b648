#pragma once

#include "spectrum/NoiseBackground.h"
#include "spectrum/Spectrogram.h"

#include <vector>

namespace faintline {

/// What a background lacks near steep edges of the noise, for each bin of the spectrogram: ln of the median over time
/// of y/B over that of noise; 0 elsewhere, and empty where nothing is steep or the recording has fewer than 1024
/// windows.
///
/// Between two cells ln B is interpolated. Where noise falls by 60 dB within a few cells it is curved, so that half a
/// cell is 1 to 2 dB louder than that, and a running median over frequency rounds the corners. Either lasts as long as
/// the edge, as a line would. Within six cells of a fall of 5 dB from one cell to the next the bins themselves are
/// measured, from 1024 frames over the whole recording, which tell a bin's noise to 5 %. At most 2 dB are taken for
/// noise: a line that stands out of an edge by more stays one.
std::vector<float> edgeCorrection(const Spectrogram &spectrogram, const NoiseBackground &background);

} // namespace faintline
