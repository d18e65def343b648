#pragma once

#include "analysis/Analysis.h"
#include "base/RunContext.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// What one should know of an analysis before taking its numbers at their word, and the settings that would help.
struct Advice {
    std::string name;     ///< "slopeLimit", "closeLines", "constantCells", "commonNoise": the same whatever it says
    std::string sentence; ///< without a full stop
    std::string remedy;   ///< "use a window of 0.25 s"; empty where no setting helps
    AnalysisSettings settings{}; ///< with the remedy
};

/// The remedy is a window of that length, to two digits.
void setWindow(Advice &advice, double seconds);

/// Lines of one axis that keep to the end of the model's slope set: sure tracks (sureStatistic.h) whose slope is the
/// steepest one in more than half of their frames, if they have a twentieth of all sure tracks' frames. Faster lines
/// are lost or cut. In a window half as long the same drift is a quarter of the slope in bins a frame.
std::optional<Advice> adviceOnSlopes(const Analysis &analysis);

/// Pairs of sure tracks of the analysis' own window that run side by side for most of the shorter one's time, less than
/// three resolution cells apart and with a distance that stays within half a cell: lines that the window hardly
/// separates. Nothing is advised where the window that would put them four cells apart is longer than a sixteenth of
/// the recording, or where the lines' drift would leave the slope set in it.
std::optional<Advice> adviceOnCloseLines(const Analysis &analysis);

/// Recordings without noise, whose cells hardly change: noise of one frame has a variance of its mean squared, and
/// cells where it is less than a twentieth of that are constant. Advised where nine cells of ten are.
/// Cost: some 200 frames are read. Throws Cancelled.
std::optional<Advice> adviceOnConstantCells(const Analysis &analysis, const RunContext &context = {});

/// Channels that are added, but share their noise: two channels of coherence |γ|² carry the evidence of 2/(1 + |γ|²)
/// independent ones, and noise exceeds a threshold more often than calibrated. Over the cells without steady lines
/// |γ|² = 4c/(3 + c), c the correlation of e^(-y) in two channels, which is uniform in each of them. Advised where a tenth of the channels is lost. Cost: some 200 frames of each are read. Throws Cancelled.
std::optional<Advice> adviceOnChannels(const Analysis &analysis, const RunContext &context = {});

/// All that applies, the gravest first.
std::vector<Advice> advise(const Analysis &analysis, const RunContext &context = {});

} // namespace faintline
