#pragma once

#include "base/Random.h"
#include "evaluate/sequential/SequentialStudy.h"
#include "evaluate/sequential/TrajectorySampler.h"

#include <span>
#include <vector>

namespace faintline {

/// One trial of a study: its frames and its truth, as in `simulate`.
class SequentialTrial
{
public:
    SequentialTrial(const SequentialStudy &study, const TrajectorySampler &sampler, Index trial);

    /// The next stage's frame, one block of the model's cells per folded cell. Valid until the next call.
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
    Index m_stage = 0; ///< of the next frame
    Index m_state = -1;
    Index m_folded = 0;
};

} // namespace faintline
