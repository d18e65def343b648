#pragma once

#include "plan/Analysis.h"

namespace faintline {

/// Decides jointly which way two equal signals take that run beside each other.
///
/// Between signals of similar power within three resolution cells, tracks change from one to the other. For each pair
/// of tracks that are so near for four times `slopeFrames` or more, both at 3 dB or more and within 6 dB of each other,
/// and with no third signal beside them, the most probable pair of paths (jointPaths.h) replaces their ways. What was
/// measured in a frame is kept with the path that it lies on; elsewhere the position is the path's cell, and the band
/// one resolution cell wide. Signals that meet and part keep the identities that their ways before and after gave them
/// (relink.h). Tracks of which four fifths lie on these paths are pieces of them and are removed.
///
/// `slopeFrames`: frames over which a track's way is measured (RelinkRule). Throws Cancelled.
std::vector<Track> decideJointly(const Analysis &analysis, std::vector<Track> tracks, Index slopeFrames,
                                 const RunContext &context);

} // namespace faintline
