#pragma once

#include "base/Field.h"
#include "base/LargeVector.h"
#include "detect/PathDetector.h"
#include "model/MarkovModel.h"
#include "recursion/Recursion.h"

#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace faintline {

/// How K, the factor by which a path's evidence fades, is determined.
enum class ResetLaw {
    Fixed, ///< a given ln K (calibrated on noise, or by hand)
    Mean,  ///< K(t) = K0 - mean of the continued scores (Parsons 2008)
    Half,  ///< integral control toward 50 % of the states continued
    None   ///< no reset: all paths start in the first frame (fixed-window Viterbi)
};

inline constexpr std::array<std::string_view, 4> resetLawNames{"fixed", "mean", "half", "none"};

/// The reset law and its constants.
struct ResetRule {
    ResetLaw law = ResetLaw::Fixed;
    double lnK = 0.0;  ///< Fixed: ln K; Half: initial ln K
    double k0 = 0.0;   ///< Mean: K0
    double gain = 0.1; ///< Half: change of ln K per frame and unit of deviation from ½
};

/// The sequential Markov detector.
///
///   u(n, 0) = λ(n, 0)
///   u(n, t) = λ(n, t) + max( ln K + max_m [ ln P(n|m) + u(m, t-1) ], 0 )
///
/// u = ln(N Λ), the log-likelihood ratio in nats above the background of a uniform initial law 1/N; a path is *reset*
/// where the second argument of the outer max is strictly greater. D(t, cell) = max over the cell's rates. Decision: D
/// > threshold. Under Mean the statistic is u + K(t), which is Parsons' ln Λ, and K(t) applies to the next frame's
/// predecessors. The reset fraction and the mean that regulate K are taken over the cells that are not inhibited. Half
/// is integral control, ln K += gain·(½ - fraction continued), with a response time of some ten frames; gains of 1 and
/// more oscillate. Source: Billon 2005 section 3, Parsons 2008 eq. 8 and 10. Oracle: enumeration of all paths;
/// Lindley's recursion in closed form for one-to-one transitions.
class Smd final : public PathDetector
{
public:
    Smd(const MarkovModel &model, const ResetRule &rule);

    void update(std::span<const float> y, std::span<float> statistic) override;
    void updateBlock(std::span<const float> y, std::span<float> statistic, Index cells) override;
    Index takenTogether(std::span<const float> y) const override;
    std::vector<Regulation> updateTogether(std::span<const float> y, std::span<float> statistic,
                                           std::span<const std::vector<Index>> inhibited) override;
    void takeBack() override;
    void useThreads(int threads) override { m_recursion.useThreads(threads); }
    void forget(const Grid &grid, const CellBox &box) override;
    void inhibit(std::span<const Index> cells) override { m_inhibited.assign(cells.begin(), cells.end()); }
    std::span<const float> scores(std::size_t /*model*/ = 0) const override { return m_scores; }
    /// K(t) under Mean, 0 otherwise.
    double offset(std::size_t /*model*/ = 0) const override { return m_offset; }
    Regulation regulation(std::size_t /*model*/ = 0) const override { return m_regulation; }

    std::shared_ptr<const DetectorState> state() const override;
    void setState(const DetectorState &state) override;

private:
    struct SmdState;

    void start(std::span<const float> y, std::span<float> statistic);
    std::vector<Continued> advance(std::span<const float> y, std::span<float> statistic,
                                   std::span<const std::vector<Index>> inhibited = {});
    std::vector<Index> notCounted(std::span<const float> y) const;
    Continued continuedAt(const std::vector<Index> &places, std::span<const float> y) const;
    void regulate(double continuedFraction, double meanContinued);

    StateSpace m_space;
    Likelihood m_likelihood;
    ResetRule m_rule;
    Recursion<MaxPlus<float>> m_recursion;
    LargeVector<float> m_scores;
    LargeVector<float> m_next; ///< those before the last frames, and scores being computed
    double m_lnK;
    double m_offset = 0.0;
    Index m_frames = 0;            ///< number of frames taken; the step into frame n is step number n
    Index m_framesBefore = 0;      ///< the same before the last ones …
    Regulation m_regulationBefore; ///< … and their regulation
    std::vector<Index> m_inhibited;
    Regulation m_regulation;
};

} // namespace faintline
