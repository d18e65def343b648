#pragma once

#include "base/RunContext.h"
#include "plan/Analysis.h"

namespace faintline {

/// A law of slope changes learned from an analysis' own tracks, and the present law.
struct LearnedMotion {
    std::vector<double> present; ///< h(0), h(1), …
    std::vector<double> learned;
    double presentLnK = 0.0; ///< nat, calibrated for each law
    double learnedLnK = 0.0;
    double presentThreshold = 0.0; ///< nat, at the same rate of false alarms
    double learnedThreshold = 0.0;
    /// Gain per frame of a path of these signals under the learned law: Σ share(i)·ln(h_learned(i)/h_present(i)) + ln
    /// K_learned - ln K_present.
    double gainPerFrame = 0.0;
    std::size_t tracks = 0; ///< number of tracks used
    double frames = 0.0;

    /// Gain over the threshold for a path of `frames` frames, nat.
    double gainOver(double pathFrames) const { return pathFrames * gainPerFrame + presentThreshold - learnedThreshold; }
};

/// Whether motion can be learned from an analysis: it has lines and more than one slope.
bool canLearnMotion(const Analysis &analysis);

/// Estimates the law h of an analysis's tracks by expectation maximisation: the expected numbers of slope changes by 0,
/// 1, … steps are counted in corridors around the tracks (slopeChangesOf), and h is set to their shares; three
/// iterations from h(0) = 0.9 with the rest shared equally; h(0) stays in 0.8 … 0.998. Uses the strongest tracks that
/// are a hundred times rarer on noise than specified, up to 20 000 frames in total. Throws Error without such tracks,
/// Cancelled. Source: Baum and others 1970.
LearnedMotion learnMotion(const Analysis &analysis, const RunContext &context = {});

/// The settings of the analysis with the learned law.
AnalysisSettings withLearnedMotion(const Analysis &analysis, const LearnedMotion &motion);

} // namespace faintline
