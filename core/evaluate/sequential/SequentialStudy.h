#pragma once

#include "base/Interval.h"
#include "detect/MapTrajectory.h"
#include "detect/Sprt.h"
#include "model/TrajectorySampler.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace faintline {

/// What is simulated: a sequential test designed for one world, run in another.
///
/// Cells are exponential: mean 1 without the target, 1 + actualSnr with it (Grossi and Lops 2006, eq. 10); the target's
/// start and moves follow the model's law. The model's likelihood, exponential with the design SNR, makes λ.
struct SequentialStudy {
    SequentialModel model;
    SprtSettings sprt;
    std::optional<double> actualSnr; ///< power ratio; nothing: noise only
    Index trials = 1000;
    std::uint64_t seed = 1;
    Index averagedCells = 0;          ///< N of averageCells along the model's last axis; 0: the noise power is known
    bool estimatesTrajectory = false; ///< where H1 is accepted
    Index lastWithinCells = 2;        ///< P_c,last: largest error at the stopping stage that counts as correct
    Index trackWithinCells = 5;       ///< P_c,track: the same over all stages
};

/// A mean over trials and its standard error.
struct Estimate {
    double value = 0.0;
    double standardError = 0.0;

    Interval interval() const { return normalInterval(value, standardError); }
};

/// What came of it.
struct SequentialOutcome {
    Index trials = 0;
    Index acceptedH1 = 0;
    Index undecided = 0; ///< after a million stages
    Estimate stages;     ///< average sample number
    double deviationStages = 0.0;
    Estimate variation; ///< coefficient of variation, deviation over mean
    /// The other hypothesis's error probability by change of measure: on noise β = E0[Λ; H0 accepted], with a signal
    /// α = E1[1/Λ; H1 accepted]. True where the data follow the design (actual SNR, no cell averaging).
    Estimate otherError;
    Index correctLast = 0; ///< of the accepted ones
    Index correctTrack = 0;
    std::vector<Index> stopCounts; ///< trials that stopped after stage 1, 2, …
};

/// Simulates it, several trials abreast: they are an axis of the recursion along which nothing moves. A trial is a pure
/// function of (seed, trial); no result depends on threads. Evidence in single precision and at most 88 nats a cell,
/// weights in double precision and unscaled, as Λ lies between the boundaries. Throws Error, Cancelled.
SequentialOutcome simulate(const SequentialStudy &study, const RunContext &context = {});

/// One trial of a study: its frames and its truth, as `simulate` had them.
class SequentialTrial
{
public:
    SequentialTrial(const SequentialStudy &study, const TrajectorySampler &sampler, Index trial);

    /// The next stage's frame, folded cell by folded cell, each a block of the model's cells. Valid until the next
    /// call.
    std::span<const float> next();

    Index state() const { return m_state; }   ///< of the target in the last frame
    Index folded() const { return m_folded; } ///< its cell on the folded axes

private:
    const SequentialStudy *m_study;
    const TrajectorySampler *m_sampler;
    Random m_noise;
    Random m_target;
    Index m_frameCells;
    Index m_bufferFrames;
    Index m_used;
    std::vector<float> m_buffer;
    std::vector<float> m_frame;
    Index m_stage = 0; ///< of the next frame
    Index m_state = -1;
    Index m_folded = 0;
};

/// The fixed number of stages at which a likelihood ratio test has the same errors: the smallest n for which a
/// threshold on Λ_n exists with α by change of measure and β by counting within those of `study.sprt`, over
/// `study.trials` runs at the design SNR. An estimate: at β = 1e-3 and 20 000 trials n is good to some per cent.
/// Nothing if it exceeds `largest`.
std::optional<Index> simulatedFixedSampleSize(const SequentialStudy &study, Index largest,
                                              const RunContext &context = {});

} // namespace faintline
