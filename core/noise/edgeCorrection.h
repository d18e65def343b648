#pragma once

#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

#include <vector>

namespace faintline {

/// Computes the correction of a background for each bin of the spectrogram, from up to 8192 frames of the whole
/// recording: ln of a factor, 0 for bins that need none. Empty if the recording has fewer than 1024 windows. Let r be
/// ln of a bin's mean over time of y/B, estimated from the share of its values below ln 2; a line present for less than
/// half of the time hardly changes it.
///
/// - *Steep edges.* ln B is interpolated linearly between cells. Where noise falls by 60 dB within a few cells, ln B is
///   curved, so that the true value half a cell away is 1 to 2 dB higher, and a running median over frequency rounds
///   the corners. Both errors persist like a line. Within six cells of a fall of 5 dB between adjacent cells, r is
///   therefore applied bin by bin, plus a margin of ½·30·σ² for its error σ (as in CausalSpectrogram). It is limited to
///   2 dB, so that a line that exceeds an edge by more remains.
/// - *Correlated frames.* The noise of a bin on a flank, or in the leakage beyond it, comes from the band's last cell.
///   It is narrower than the window's main lobe and therefore correlated over several frames, of which only one in
///   c = 1 + 2 Σ ρ (relative to most bins) is independent evidence. The exponent of a false alarm of θT = 12 nat then
///   becomes 12/c; a level higher by (12/50)·(1 - 1/c) compensates for it, with d ln rate/dε = 50.
/// - *Round tops.* The median over 41 cells flattens a hump of that width. Elsewhere the running median of r over
///   ±5 cells is therefore applied if it exceeds four standard errors and is below 2 dB.
std::vector<float> edgeCorrection(const Spectrogram &spectrogram, const NoiseBackground &background);

} // namespace faintline
