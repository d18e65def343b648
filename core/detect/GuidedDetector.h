#pragma once

#include "detect/Smd.h"

#include <memory>

namespace faintline {

/// A detector without paths combined with a sequential Markov detector: the first one decides, the second one gives the
/// path, so that tracks can be started from any detector's events.
///
/// The statistic is that of the first detector; scores and regulation are those of the second one.
class GuidedDetector final : public PathDetector
{
public:
    /// `shown`: a detector like the decider, which takes all frames as they are and forgets nothing (showStatistic);
    /// null: the statistic is only decided on.
    GuidedDetector(std::unique_ptr<Detector> decider, const MarkovModel &model, const ResetRule &rule,
                   std::unique_ptr<Detector> shown = {})
        : m_decider(std::move(decider)), m_shown(std::move(shown)), m_guide(model, rule)
    {
    }

    void update(std::span<const float> y, std::span<float> statistic) override
    {
        m_guide.update(y, statistic);
        m_decider->update(y, statistic);
    }

    void showStatistic(std::span<const float> y, std::span<float> statistic) override
    {
        if (m_shown)
            m_shown->update(y, statistic);
    }

    void forget(const Grid &grid, const CellBox &box) override
    {
        m_guide.forget(grid, box);
        m_decider->forget(grid, box);
    }

    void useThreads(int threads) override
    {
        m_guide.useThreads(threads);
        m_decider->useThreads(threads);
        if (m_shown)
            m_shown->useThreads(threads);
    }

    std::span<const float> scores(std::size_t /*model*/ = 0) const override { return m_guide.scores(); }
    double offset(std::size_t /*model*/ = 0) const override { return m_guide.offset(); }
    Regulation regulation(std::size_t /*model*/ = 0) const override { return m_guide.regulation(); }

private:
    std::unique_ptr<Detector> m_decider;
    std::unique_ptr<Detector> m_shown;
    Smd m_guide;
};

} // namespace faintline
