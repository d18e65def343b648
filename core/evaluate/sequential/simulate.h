#pragma once

#include "base/Interval.h"
#include "base/RunContext.h"
#include "evaluate/sequential/SequentialTrial.h"

#include <optional>
#include <vector>

namespace faintline {

/// A mean over trials and its standard error.
struct Estimate {
    double value = 0.0;
    double standardError = 0.0;

    Interval interval() const { return normalInterval(value, standardError); }
};

/// Result of a study.
struct SequentialOutcome {
    Index trials = 0;
    Index acceptedH1 = 0;
    Index undecided = 0; ///< after a million stages
    Estimate stages;     ///< average sample number
    double deviationStages = 0.0;
    Estimate variation; ///< coefficient of variation, deviation over mean
    /// The other hypothesis's error probability by change of measure: on noise β = E0[Λ; H0 accepted], with a signal α
    /// = E1[1/Λ; H1 accepted]. Valid if the data follow the design (actual SNR, no cell averaging).
    Estimate otherError;
    Index correctLast = 0; ///< number among the accepted ones
    Index correctTrack = 0;
    std::vector<Index> stopCounts; ///< number of trials that stopped after stage 1, 2, …
};

/// Simulates a study, several trials at once, as an axis of the recursion without moves. A trial is a pure function of
/// (seed, trial); results do not depend on threads. Evidence is in single precision and at most 88 nats per cell,
/// weights in double precision and unscaled, because Λ lies between the boundaries. Throws Error, Cancelled.
SequentialOutcome simulate(const SequentialStudy &study, const RunContext &context = {});

/// The fixed number of stages at which a likelihood ratio test has the same errors: the smallest n for which a
/// threshold on Λ_n exists with α by change of measure and β by counting within those of `study.sprt`, over
/// `study.trials` runs at the design SNR. An estimate: at β = 1e-3 and 20 000 trials n is accurate to some per cent.
/// Nothing if it exceeds `largest`.
std::optional<Index> simulatedFixedSampleSize(const SequentialStudy &study, Index largest,
                                              const RunContext &context = {});

} // namespace faintline
