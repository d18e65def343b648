#include "evaluate/sequential/SequentialTrial.h"

#include "detect/cellAveraging.h"

#include <algorithm>

namespace faintline {

SequentialTrial::SequentialTrial(const SequentialStudy &study, const TrajectorySampler &sampler, Index trial)
    : m_study(&study), m_sampler(&sampler), m_noise(study.seed, 2 * std::uint64_t(trial)),
      m_target(study.seed, 2 * std::uint64_t(trial) + 1), m_frameCells(study.model.reduction.frameCells())
{
    // Whole blocks of four random words at a time, about 256 cells, or one frame.
    m_bufferFrames =
        m_frameCells % 4 == 0 ? std::max<Index>(1, 256 / m_frameCells) : 4 * std::max<Index>(1, 64 / m_frameCells);
    m_used = m_bufferFrames;
    m_buffer.resize(std::size_t(m_bufferFrames * m_frameCells));
}

std::span<const float> SequentialTrial::next()
{
    if (m_used == m_bufferFrames) {
        m_noise.exponentials(m_buffer);
        m_used = 0;
    }
    const std::span<float> y(m_buffer.data() + m_used * m_frameCells, std::size_t(m_frameCells));
    ++m_used;
    if (m_study->actualSnr) {
        m_state = m_state < 0 ? m_sampler->first(m_target) : m_sampler->next(m_state, m_target, m_stage);
        ++m_stage;
        const StateSpace &space = m_study->model.markov.space;
        if (const Index folded = m_study->model.reduction.foldedCells(); folded > 1)
            m_folded = Index(m_target.uniform() * double(folded));
        float &cell = y[std::size_t(m_folded * space.cellCount() + space.cellOf(m_state))];
        cell *= float(1.0 + *m_study->actualSnr);
    }
    if (m_study->averagedCells > 0) {
        averageCells(y, m_study->model.markov.space.axes().back().cells, m_study->averagedCells);
        correctAveraged(y, m_study->averagedCells, m_study->model.markov.likelihood.snr());
    }
    return y;
}

} // namespace faintline
