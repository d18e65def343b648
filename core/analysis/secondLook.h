#pragma once

#include "analysis/Analysis.h"
#include "track/Area.h"

#include <span>
#include <vector>

namespace faintline {

/// Whether complete tracks are looked at a second time: those of the sequential Markov detector's paths through a
/// spectrogram, if asked for. Not under the linear likelihood, which rescales scores for a fixed level and says nothing
/// of a track's own.
bool looksTwice(const AnalysisPlan &analysis);

/// What the look from both ends makes of the chain's tracks.
struct SecondView {
    std::vector<Track> tracks; ///< lines, by detection
    std::vector<Area> areas;   ///< by time
};

/// What was found, seen from both ends: each signal only while it was there, and where it was to a fraction of a bin.
///
/// The chain decides causally what is found; its statistic stays as it is, and so do times of detection, but for those
/// that lie outside of where the signal turned out to be: they are put at its nearer end. Each of the chain's tracks,
/// the strongest first, is looked at in a strip of frames around its path (bothWays.h):
///
///   1. y is divided by the floor that stronger tracks raise (explanation.h);
///   2. a track that the detector would not have found over that floor was theirs: it goes; so does one of which less
///      than the threshold is left over the level of what it runs through (levelBeside.h): it was a path through a
///      burst, a cloud or a hum, which becomes an area;
///   3. the stretches where the signal is present stay, joined over up to 24 frames: the one in which the path's
///      statistic gained most, and every other whose own evidence reaches the threshold, which is then its statistic;
///   4. what stays is explained: it raises the floor for weaker ones.
///
/// `subtracted`: lines that the frames were made without (subtractLines.h). What is left of them, and their skirts, is
/// explained before all others: they are no signals of their own.
///
/// `found`: by detection, as is the answer, numbered anew. Reads all frames once; memory goes with the tracks' length.
/// Deterministic.
SecondView lookTwice(const Analysis &analysis, std::vector<Track> found, std::span<const Track> subtracted,
                     const RunContext &context);

} // namespace faintline
