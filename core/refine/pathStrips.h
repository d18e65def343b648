#pragma once

#include "plan/Analysis.h"
#include "recursion/PathStrip.h"
#include "refine/bothWays.h"

#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace faintline {

/// Fills strips of an analysis's frames, whose positions are set, in any order and number, in one pass: y as the
/// detector takes it, 0 in excluded cells. `what`: activity shown with the progress. Throws Cancelled.
void readStrips(const Analysis &analysis, std::vector<PathStrip *> strips, const RunContext &context,
                std::string_view what);
void readStrips(const Analysis &analysis, std::span<PathStrip> strips, const RunContext &context,
                std::string_view what);
/// The same of any frames, y as it is.
void readStrips(const NormalisedFrames &frames, std::span<PathStrip> strips, const RunContext &context,
                std::string_view what);

/// Reads as many strips at a time as 16 MiB hold, and calls take(number) for each in order, which is empty afterwards.
void readInTurn(const Analysis &analysis, const std::vector<PathStrip *> &strips, const RunContext &context,
                std::string_view what, const std::function<void(std::size_t)> &take);

/// An empty strip along the cells of a track's path.
PathStrip stripAlong(const Track &track, Index halfWidth);

/// What the passes of refine/bothWays need of an analysis of lines; lnK is that of a strip (setLnK).
BothWaysModel bothWaysModel(const Analysis &analysis);

void setLnK(BothWaysModel &model, const Analysis &analysis, const PathStrip &strip);

} // namespace faintline
