#pragma once

#include "plan/AnalysisPlan.h"
#include "track/Track.h"

#include <vector>

namespace faintline {

/// Removes the tracks of a family that stronger ones account for: their members coincide with some of a stronger
/// track's, for example at half or twice its fundamental, and their statistic does not exceed what these explain.
///
/// A share s of coinciding members carries at most E = s times the stronger track's statistic. A track is a signal of
/// its own if it exceeds 1.5·E and lies at least the threshold above E. The remaining tracks keep their order and are
/// renumbered. Does nothing if no family is set. Precondition: a family needs spectrogram frames.
std::vector<Track> withoutGhosts(const AnalysisPlan &plan, std::vector<Track> tracks);

} // namespace faintline
