#pragma once

#include "plan/Analysis.h"
#include "refine/explanation.h"
#include "track/Area.h"

#include <span>
#include <vector>

namespace faintline {

/// Whether tracks can have a second pass under these settings: paths of the sequential Markov detector. Not under the linear likelihood, which rescales scores for a fixed level and ignores a track's own level.
bool canLookTwice(const AnalysisSettings &settings);

/// Whether completed tracks get a second pass: if it is possible and enabled, through a spectrogram, with one model.
bool looksTwice(const AnalysisPlan &analysis);

/// Whether completed tracks are only cut to their signals: lines for which a second pass is enabled but impossible,
/// because their frames are ready-made, or because another detector decides.
bool cutsOnly(const AnalysisPlan &analysis);

/// Cuts tracks to the frames from the first to the last one in which their signal is present (bothWays.h): a tracker
/// follows noise for as long as it costs nothing. Tracks that are present nowhere stay as they are.
std::vector<Track> cutToSignals(const Analysis &analysis, std::vector<Track> tracks, const RunContext &context);

/// What a second pass makes of tracks.
struct SecondView {
    std::vector<Track> tracks;           ///< lines, in the order in which they were explained
    std::vector<Area> areas;             ///< not joined
    std::vector<Track> explainedByNoise; ///< pieces of tracks that are as common in their surroundings
    Explanations explanations;           ///< the floor that the lines raise
};

/// Two-sided second pass over detected tracks: limits each signal to the time it was present and estimates its position
/// to a fraction of a bin.
///
/// The chain decides causally what is detected; its statistic is not changed, nor are times of detection, except those
/// outside the signal's estimated extent, and of further stretches: these were detected where their own evidence reached
/// the threshold. Each of the chain's tracks, the strongest first, is processed in a strip of frames around its path
/// (bothWays.h):
///
///   1. y is divided by the floor that stronger tracks raise (explanation.h);
///   2. a track that the detector would not have found over that floor belongs to them and is removed; so is one with
///      less than the threshold above the level of its surroundings (levelBeside.h): it was a path through a burst, a
///      cloud or a hum, which becomes an area; so is one with less than that when divided by V, by which runs of power
///      beside it, along the positions of step 3, vary more than those of noise (runsBeside): it was a path through
///      speckle, which noise explains;
///   3. in cells that are nearer to another track 3 cells or more beside it, with less than half of either's power midway,
///      nothing is to be seen; the stretches where the signal is present are kept, joined over up to 24 frames: the one
///      in which the path's statistic gained most, and every other whose own evidence reaches the threshold, which is
///      then its statistic;
///   4. remaining tracks are explained: they raise the floor for weaker ones;
///   5. signals that they hide are searched for behind them (explanation.h), which then take the same steps, until
///      nothing more is found;
///   6. where signals met, the pieces of tracks before and after are assigned to each other anew (relink.h);
///   7. equal signals that run beside each other are decided jointly (decideJointly.h).
///
/// The ends of the resulting tracks are still generous, for comparison with other windows and for subtraction; they are
/// trimmed at the very end of an analysis (trimEnds.h).
///
/// lookTwice takes steps 1 to 4, lookBehind the others, except for families, whose members lie beside each other.
///
/// Over a causal background each track is asked alone, so that a live run can ask as soon as one has ended: nothing
/// explains anything else, steps 4 to 7 are left out, and what is present of a track is one track, with pauses, under
/// its number.
///
/// `subtracted`: lines that were removed before the frames were made (subtractLines.h). Their remainders and skirts are
/// explained before all others, because they are not separate signals.
///
/// `found`: ordered by detection. Reads all frames once; memory is proportional to the tracks' length. Deterministic.
SecondView lookTwice(const Analysis &analysis, std::vector<Track> found, std::span<const Track> subtracted,
                     const RunContext &context);
SecondView lookBehind(const Analysis &analysis, SecondView view, const RunContext &context);

} // namespace faintline
