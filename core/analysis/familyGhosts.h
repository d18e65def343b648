#pragma once

#include "analysis/Analysis.h"

#include <vector>

namespace faintline {

/// Without the tracks that stronger ones account for: of a family, every track whose members coincide with some of a
/// stronger one's, at half or twice its fundamental for instance, and whose statistic is no more than these explain.
///
/// A share s of coinciding members has the share s of the signal's evidence at most; what exceeds 1.5·s of the stronger
/// track's statistic, and s of it by the threshold, is a signal of its own. The rest keeps its order and gets new
/// numbers. Nothing happens where no family is set. Precondition: of a family, frames of a spectrogram.
std::vector<Track> withoutGhosts(const AnalysisPlan &plan, std::vector<Track> tracks);

} // namespace faintline
