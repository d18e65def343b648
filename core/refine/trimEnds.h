#pragma once

#include "track/Track.h"

#include <vector>

namespace faintline {

/// Cuts each track to the frames from the first to the last one in which its signal is present (Track::isPresent), and
/// one more at both ends: windows overlap, and there the signal fills only a part of its window. Tracks without such a
/// frame are not cut. A detection outside is moved to the nearest frame with signal. The result is ordered and numbered
/// by detection; tracks of which none was seen in a second pass are returned as they are.
///
/// This is the last step before tracks are reported. The choice of the window, the subtraction of lines and the linking
/// of pieces use the untrimmed tracks, which are longer where a signal fades.
std::vector<Track> withEndsTrimmed(std::vector<Track> tracks);

/// The same for one track, which keeps its number.
void trimEnds(Track &track);

} // namespace faintline
