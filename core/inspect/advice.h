#pragma once

#include "base/RunContext.h"
#include "inspect/explain.h"
#include "plan/Analysis.h"

#include <optional>
#include <string>
#include <vector>

namespace faintline {

/// A caveat about an analysis's numbers, and settings that would help.
struct Advice {
    std::string name; ///< "slopeLimit", "closeLines", "constantCells", "commonNoise", "silence", "stopBand"; of a cell
                      ///< "fastLine", "threshold": independent of the wording
    std::string sentence;        ///< without a full stop
    std::string remedy;          ///< "use a window of 0.25 s"; empty if no setting helps
    AnalysisSettings settings{}; ///< settings with the remedy
};

/// Sets the remedy to a window of that length, to two digits.
void setWindow(Advice &advice, double seconds);

/// Whether a window of about that length was asked besides the chosen one (otherWindows.h): as short or as long.
bool isAsked(const Analysis &analysis, double windowSeconds);

/// Lines at the limit of the model's slope set, for frames on one axis: sure tracks (AnalysisPlan::sureStatistic) with
/// the steepest slope in more than half of their frames, if they have a twentieth of all sure tracks' frames. Faster
/// lines are lost or cut. In a window half as long the same drift is a quarter of the slope in bins per frame. No
/// advice if shorter windows were asked, which follow them.
std::optional<Advice> adviceOnSlopes(const Analysis &analysis);

/// Pairs of sure tracks of the analysis' own window that run side by side for most of the shorter one's time, less than
/// three resolution cells apart, with a distance constant to within half a cell: lines that the window hardly resolves.
/// No advice if the window that would separate them by four cells was asked or is longer than a sixteenth of the
/// recording, or if the lines' drift would leave the slope set in it.
std::optional<Advice> adviceOnCloseLines(const Analysis &analysis);

/// Recordings without noise, whose cells hardly change. In noise, the variance of a frame equals its squared mean;
/// cells with less than a twentieth of that are constant. Advice is given if nine cells of ten are.
/// Cost: reads some 200 frames. Throws Cancelled.
std::optional<Advice> adviceOnConstantCells(const Analysis &analysis, const RunContext &context = {});

/// Added channels that share their noise: two channels of coherence |γ|² carry the evidence of 2/(1 + |γ|²) independent
/// ones, and noise exceeds a threshold more often than calibrated. Over the cells without steady lines |γ|² = 4c/(3 +
/// c), with c the correlation of e^(-y), which is uniform, in two channels. Advice is given if a tenth of the channels
/// is lost. Cost: reads some 200 frames of each. Throws Cancelled.
std::optional<Advice> adviceOnChannels(const Analysis &analysis, const RunContext &context = {});

/// Stop bands of a filter (stopBands.h), which are not searched unless they are selected.
std::optional<Advice> adviceOnStopBands(const Analysis &analysis);

/// Recordings of silence, in which there is nothing to find.
std::optional<Advice> adviceOnSilence(const Analysis &analysis, const RunContext &context = {});

/// The largest slope of a state set, bins per frame.
double steepestSlope(const StateSpace &space);

/// Why a cell was not detected, if there is a cure; for frames of lines. Either a line runs through it that drifts
/// faster than the model, in all windows that were asked, allows: a straight stretch of up to 65 frames whose cells,
/// as many of each frame as the line crosses in it, exceed those beside them. Their mean, of y clipped at 5, is tested
/// against the exponential law, with as many independent cells as there are; the log-likelihood ratio must exceed the
/// threshold and the logarithm of the number of stretches that were tried. The remedy is a window that is halved until
/// the model allows that drift. Or the statistic is above half the threshold: the remedy is the rate of false alarms
/// with which it would be an event, as long as that is at most a hundred times the requested one. Nothing for cells
/// that are followed by a track, or kept from the detector. Cost: reads 65 frames. Throws Cancelled.
std::optional<Advice> adviceOnCell(const Analysis &analysis, const Explanation &explanation,
                                   const RunContext &context = {});

/// All advice that applies, most serious first; of silence, nothing else.
std::vector<Advice> advise(const Analysis &analysis, const RunContext &context = {});

} // namespace faintline
