#pragma once

#include "detect/PathDetector.h"
#include "detect/Smd.h"
#include "model/MarkovModel.h"
#include "recursion/Recursion.h"

#include <vector>

namespace faintline {

/// The sum-product variant of the sequential Markov detector: all paths count, not only the best.
///
///   A(n, t) = e^{λ(n, t)} · ( K Σ_m P(n|m) A(m, t-1) + r ),   u = ln A
///
/// with r = 1 under a fixed reset law (Shiryaev-Roberts) and r = 0 under none, where ln Σ A/N is the log-likelihood
/// ratio of "a signal since the first frame" (Grossi and Lops 2006, Algorithm 3.1). Stored as scaled weights, so that a
/// thousand frames neither overflow nor lose digits; if the evidence of one frame spans more than the range of a
/// double, logarithms are used (a path more than 700 nats below the best one then counts no more than a new one).
/// Oracle: enumeration of all paths in the linear domain.
class SumDetector final : public PathDetector
{
public:
    /// Throws Error for a law other than fixed or none.
    SumDetector(const MarkovModel &model, const ResetRule &rule);

    void update(std::span<const float> y, std::span<float> statistic) override;
    void forget(const Grid &grid, const CellBox &box) override;
    std::shared_ptr<const DetectorState> state() const override;
    void setState(const DetectorState &state) override;
    std::span<const float> scores(std::size_t model = 0) const override;
    double offset(std::size_t /*model*/ = 0) const override { return 0.0; }
    Regulation regulation(std::size_t /*model*/ = 0) const override { return {m_rule.lnK, 1.0, m_rule.lnK}; }

    /// ln of the mean of A over all states: the log-likelihood ratio for the uniform initial law.
    double lnMean() const { return m_lnMean; }

private:
    struct State;

    void updateWide(std::span<const double> lambda);
    void updateWeights(std::span<const double> lambda, double highest);
    float scoreOf(double weight) const;

    StateSpace m_space;
    Likelihood m_likelihood;
    ResetRule m_rule;
    Recursion<SumProduct> m_recursion;
    std::vector<double> m_weights; ///< A·e^(-scale)
    double m_scale = 0.0;
    double m_lnMean = 0.0;
    Index m_frames = 0;                  ///< number of frames taken
    mutable std::vector<float> m_scores; ///< empty until they are asked for
};

} // namespace faintline
