#pragma once

#include "inspect/doppler/DopplerPass.h"
#include "plan/AnalysisPlan.h"

#include <vector>

namespace faintline {

/// A track's frequencies for `fitDopplerPass`.
struct DopplerTrack {
    std::vector<DopplerPoint> points; ///< by time
    Index steepCount = 0;             ///< points excluded because the model cannot follow faster
    double steepestHzPerSecond = 0.0; ///< steepest fall that the model can follow
};

/// A track's absolute frequencies: those of its frames plus `centreHz`.
///
/// For a smoothed track: the smoothed path where the signal is present (probability ½ or more), with
/// SmoothedPoint::deviation. Otherwise: the cells of the path, whose rounding has a standard deviation of 1/√12 cell.
/// Where the path is as steep as the model allows (85 %), and two frames on either side, the line may drift faster than
/// the path can follow: these points are excluded, as are adjoining pieces shorter than 16 frames. A path that lags
/// behind a pass mimics a slower and nearer one. Throws Error if the frames have axes other than frequency.
DopplerTrack dopplerTrack(const AnalysisPlan &plan, const Track &track, double centreHz);

/// Several tracks of one pass, such as before and after a closest approach that was too fast to follow. Throws Error if
/// they overlap in time.
DopplerTrack joined(const std::vector<DopplerTrack> &tracks);

} // namespace faintline
