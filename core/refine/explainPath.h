#pragma once

#include "refine/bothWays.h"
#include "refine/explanation.h"

#include <vector>

namespace faintline {

/// Half width in bins of the strips from which skirts are measured: those of strong tracks.
inline constexpr Index skirtBins = 96;

/// What a followed path explains of the power around it, so that it raises the floor for weaker tracks (Explanations).
///
/// In each frame of the strip from `from` up to, not including, `to`:
///
///   f = the path's position
///   A = maximum of its level and of y - 1 within ±0.75 resolution cell of f
///
/// In a strip at least `skirtBins` wide on either side also the skirts of a modulated line, in blocks of 24 frames:
///
///   e(d) = min over d' ≤ d of the mean of y - 1 at distance d', the lower of both sides, over the mean of A
///
/// as far as that mean exceeds 1 + 3/√frames: a line on one side only is not a skirt.
ExplainedSignal explainPath(const PathStrip &strip, const BothWays &seen, Index from, Index to, double binsPerCell);

/// The same of a line that was subtracted before the frames were made (subtractLines.h): its remainder, in frames where
/// noise does not mask it (y > 7), and as a signal of its own, if there are any, its skirts, as fractions of the
/// noise's power. Within ±1 resolution cell of the path, where subtraction leaves less than noise, skirts are those at
/// that distance.
std::vector<ExplainedSignal> explainSubtracted(const PathStrip &strip, double binsPerCell);

} // namespace faintline
