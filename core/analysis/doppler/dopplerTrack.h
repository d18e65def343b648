#pragma once

#include "analysis/Analysis.h"
#include "analysis/doppler/DopplerPass.h"

#include <vector>

namespace faintline {

/// A track's frequencies for `fitDopplerPass`.
struct DopplerTrack {
    std::vector<DopplerPoint> points; ///< by time
    Index steepCount = 0;             ///< points that were left out because the model could not follow faster
    double steepestHzPerSecond = 0.0; ///< the fastest fall that the model follows
};

/// A track's absolute frequencies: those of its frames plus `centreHz`.
///
/// Of a track that was looked at from both ends: the smoothed path where the signal is present (probability ½ or more),
/// with SmoothedPoint::deviation. Of another: the cells of the path, rounded, so with a standard deviation of 1/√12
/// cell. Where the path is as steep as the model allows (85 %), and two frames to either side, the line may be drifting
/// faster than the path can: these points are left out, and what is shorter than 16 frames beside them. A path that
/// lags behind a pass looks like a slower and nearer one.
/// Throws Error where the frames have more axes than frequency.
DopplerTrack dopplerTrack(const AnalysisPlan &plan, const Track &track, double centreHz);

/// Several tracks of one pass, such as before and after a closest approach that was too fast to follow. Throws Error
/// where they overlap in time.
DopplerTrack joined(const std::vector<DopplerTrack> &tracks);

} // namespace faintline
