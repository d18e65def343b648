#pragma once

#include "track/Track.h"

#include <vector>

namespace faintline {

/// Tracks from the first to the last frame in which their signal is more likely present than not
/// (SmoothedPoint::presence), with all frames between these and one more at both ends, whose windows overlap with theirs:
/// there a signal is weaker than its level, because it fills part of the window. A track without such a frame, or without the second pass,
/// stays as it is. A detection outside is moved to the nearer end. Ordered and numbered by detection.
///
/// This is the last step before tracks are reported. Windows are compared, lines are subtracted, and pieces are linked
/// by the untrimmed tracks, which are longer where a signal fades.
std::vector<Track> withEndsTrimmed(std::vector<Track> tracks);

} // namespace faintline
