#pragma once

#include "base/Random.h"
#include "detect/Sprt.h"
#include "model/TrajectorySampler.h"

#include <cstdint>
#include <optional>
#include <span>
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

} // namespace faintline
