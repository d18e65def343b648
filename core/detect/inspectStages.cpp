#include "detect/inspectStages.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr std::size_t mostValues = std::size_t(1) << 22;

    /// Collects one axis's picture.
    class Marginal
    {
    public:
        Marginal(PosteriorPicture &picture, const StateSpace &space, std::size_t axis)
            : m_picture(picture), m_cellCount(std::size_t(space.cellCount())),
              m_cells(std::size_t(space.axes()[axis].cells))
        {
            for (std::size_t after = axis + 1; after < space.axes().size(); ++after)
                m_inner *= std::size_t(space.axes()[after].cells);
            m_sum.resize(m_cells);
        }

        void add(const LikelihoodRatio &ratio)
        {
            if ((ratio.stages() - 1) % m_picture.stride != 0)
                return;
            std::fill(m_sum.begin(), m_sum.end(), 0.0);
            const std::span<const double> posterior = ratio.posterior();
            for (std::size_t state = 0; state < posterior.size(); ++state)
                m_sum[state % m_cellCount / m_inner % m_cells] += posterior[state];
            m_picture.probability.insert(m_picture.probability.end(), m_sum.begin(), m_sum.end());
            if (m_picture.probability.size() > mostValues && m_picture.rows() > 2)
                thin();
        }

    private:
        void thin()
        {
            const Index rows = (m_picture.rows() + 1) / 2;
            for (Index row = 1; row < rows; ++row)
                std::copy_n(m_picture.probability.begin() + 2 * row * m_picture.cells, m_picture.cells,
                            m_picture.probability.begin() + row * m_picture.cells);
            m_picture.probability.resize(std::size_t(rows * m_picture.cells));
            m_picture.stride *= 2;
        }

        PosteriorPicture &m_picture;
        std::size_t m_cellCount;
        std::size_t m_cells;
        std::size_t m_inner = 1;
        std::vector<double> m_sum;
    };

} // namespace

InspectedTest inspectStages(const SequentialModel &model, const SprtSettings &settings, Index stages,
                            const StageSource &source, const RunContext &context)
{
    InspectedTest inspected;
    const StateSpace &space = model.markov.space;
    for (std::size_t axis = 0; axis < model.reduction.axisCells().size(); ++axis)
        if (!model.reduction.isFolded(axis)) {
            const KinematicAxis &own = space.axes()[inspected.posterior.size()];
            inspected.posterior.push_back({axis, own.name, own.cells, 1, {}});
        }
    std::vector<Marginal> marginals;
    for (std::size_t i = 0; i < inspected.posterior.size(); ++i)
        marginals.emplace_back(inspected.posterior[i], space, i);
    inspected.result = runSprt(model, settings,
                               {stages, source,
                                [&](const LikelihoodRatio &ratio) {
                                    for (Marginal &marginal : marginals)
                                        marginal.add(ratio);
                                }},
                               context);
    return inspected;
}

} // namespace faintline
