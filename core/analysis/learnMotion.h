#pragma once

#include "analysis/analyse.h"

namespace faintline {

/// A law of slope changes as an analysis' own tracks suggest it, beside the one it was made with.
struct LearnedMotion {
    std::vector<double> present; ///< h(0), h(1), …
    std::vector<double> learned;
    double presentLnK = 0.0; ///< nat, calibrated for each
    double learnedLnK = 0.0;
    double presentThreshold = 0.0; ///< nat, at the same rate of false alarms
    double learnedThreshold = 0.0;
    /// What a path of these signals gains a frame by the learned law: Σ share(i)·ln(h_learned(i)/h_present(i)) + ln
    /// K_learned - ln K_present.
    double gainPerFrame = 0.0;
    std::size_t tracks = 0; ///< learned from
    double frames = 0.0;

    /// Gain over the threshold for a path of `frames` frames, nat.
    double gainOver(double pathFrames) const { return pathFrames * gainPerFrame + presentThreshold - learnedThreshold; }
};

/// Whether motion can be learned from an analysis: of lines, with more than one slope.
bool canLearnMotion(const Analysis &analysis);

/// The law h that suits the tracks of an analysis, by expectation and maximisation: of signals in corridors around the
/// tracks the expected number of changes of the slope by 0, 1, … steps is counted (slopeChangesOf), h is set to their
/// shares, and once more; three steps from h(0) = 0.9, the rest shared equally; h(0) stays in 0.8 … 0.998. Learned from
/// the strongest tracks that are a hundred times rarer on noise than ordered, of 20 000 frames together. Throws Error
/// without such tracks, Cancelled. Source: Baum and others 1970.
LearnedMotion learnMotion(const Analysis &analysis, const RunContext &context = {});

/// The settings of the analysis with the learned law.
AnalysisSettings withLearnedMotion(const Analysis &analysis, const LearnedMotion &motion);

} // namespace faintline
