#pragma once

#include "spectrum/NoiseBackground.h"
#include "spectrum/Spectrogram.h"

#include <vector>

namespace faintline {

/// Correction of a background, for each bin of the spectrogram, from up to 8192 frames of the whole recording; 0 where
/// nothing is to be corrected, and empty if the recording has fewer than 1024 windows. With r = ln of a bin's mean over
/// time of y/B, found from the share of its values below ln 2, which lines that are there for less than half of the
/// time hardly change:
///
/// - *Steep edges.* ln B is interpolated linearly between cells. Where noise falls by 60 dB within a few cells, ln B is
///   curved, so that the true value half a cell away is 1 to 2 dB higher, and a running median over frequency rounds
///   the corners. Both errors persist like a line. Within six cells of a fall of 5 dB between adjacent cells, r is
///   therefore taken bin by bin, plus a margin of ½·30·σ² for its error σ (as in CausalSpectrogram). At most 2 dB are
///   corrected: a line that exceeds an edge by more remains.
/// - *Frames that are alike.* The noise of a bin on a flank or in the leakage beyond it comes from the band's last
///   cell: it is narrower than the window's main lobe, and so correlated over several frames, of which only one in
///   c = 1 + 2 Σ ρ (relative to most bins) is evidence of its own. The exponent of a false alarm of θT = 12 nat then
///   becomes 12/c, and a level higher by (12/50)·(1 - 1/c) makes up for it, with d ln rate/dε = 50.
/// - *Round tops.* Elsewhere the running median of r over ±5 cells is corrected where it exceeds four standard errors
///   and is below 2 dB: in 41 cells a hump as narrow as they are loses its top.
std::vector<float> edgeCorrection(const Spectrogram &spectrogram, const NoiseBackground &background);

} // namespace faintline
