#pragma once

#include "base/Field.h"
#include "base/RunContext.h"
#include "model/SequentialModel.h"
#include "recursion/Recursion.h"

#include <array>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

namespace faintline {

/// Decision of a sequential test after a stage. H0: noise only, H1: signal and noise.
enum class SprtDecision { Undecided, H0, H1 };

inline constexpr std::array<std::string_view, 3> sprtDecisionNames{"undecided", "H0", "H1"};

/// Error probabilities and duration of a sequential test.
struct SprtSettings {
    double falseAlarm = 1e-3; ///< α: desired probability of accepting H1 on noise
    double miss = 1e-3;       ///< β: desired probability of accepting H0 with a signal, averaged over its trajectories
    int cutOffStage = 0;      ///< K: a decision is forced there; 0: never

    static const std::vector<Field<SprtSettings>> &fields();
    bool operator==(const SprtSettings &) const = default;
};

/// Throws Error naming `where` and the member.
void checkSprt(const SprtSettings &settings, const std::string &where);

/// Boundaries of the test, in nats of ln Λ.
///
///   ln γ1 = ln (1-β)/α,   ln γ0 = ln β/(1-α),   at the cut-off stage ½(ln γ0 + ln γ1)
///
/// Source: Wald's approximation, Grossi and Lops 2006, eq. 9 and section 4.3.
///
/// For the actual test, α/(1-β) and β/(1-α) are at most 1/γ1 and γ0: rigorous without a cut-off.
struct SprtBoundaries {
    double lnLower = 0.0;
    double lnUpper = 0.0;
    double lnCutOff() const { return 0.5 * (lnLower + lnUpper); }
};
SprtBoundaries sprtBoundaries(const SprtSettings &settings);

/// Decision after a stage (1, 2, …): H1 if ln Λ ≥ ln γ1, H0 if ln Λ ≤ ln γ0; at the cut-off stage otherwise H1 if ln Λ
/// ≥ ½(ln γ0 + ln γ1), else H0. Source: Grossi and Lops 2006 eq. 4 and section 3.4.
SprtDecision decide(const SprtSettings &settings, double lnLambda, Index stage);

/// The likelihood ratio of "a signal since the first stage" to "noise only".
///
///   F_1(n) = P_1(n) · e^{λ_1(n)},   F_k(n) = e^{λ_k(n)} · Σ_m P(n|m) F_{k-1}(m),   Λ_k = Σ_n F_k(n)
///
/// λ_k(n): ln p1/p0 of the state's cell at stage k. Stored as F/Λ, the posterior law of the state, and ln Λ, so that a
/// thousand stages neither overflow nor lose digits. On noise E[Λ_k] = 1. Source: Grossi and Lops 2006, Algorithm 3.1.
/// Oracle: enumeration of all trajectories. Cost: the recursion's and one exponential per cell. Use one object per
/// thread.
class LikelihoodRatio
{
public:
    explicit LikelihoodRatio(const SequentialModel &model);

    /// Takes λ of the model's cells (already folded) at the next stage; returns ln Λ.
    double update(std::span<const double> lambda);

    double lnLambda() const { return m_lnLambda; }
    Index stages() const { return m_stages; }
    std::span<const double> posterior() const { return m_posterior; } ///< P(x_k | z_1 … z_k), StateSpace order

private:
    Index m_cells;
    std::vector<double> m_initial;
    Recursion<SumProduct> m_recursion;
    std::vector<double> m_posterior;
    double m_lnLambda = 0.0;
    Index m_stages = 0;
};

/// Writes the frame of a stage (0, 1, …), reduction.frameCells() values of noise mean 1. Repeated calls must give the
/// same frame.
using StageSource = std::function<void(Index stage, std::span<double> y)>;

/// Outcome of a sequential test.
struct SprtResult {
    SprtDecision decision = SprtDecision::Undecided;
    Index stages = 0;             ///< number taken; the decision was made after the last one
    bool isForced = false;        ///< at the cut-off stage, between the boundaries
    std::vector<double> lnLambda; ///< after each stage taken
    /// Most probable cell of each stage, one index per frame axis; only if H1 was accepted.
    std::vector<std::vector<Index>> trajectory;
    double lnMapScore = 0.0; ///< ln of the trajectory's probability times its likelihood ratio
};

/// The stages available to a test.
struct StageSeries {
    Index count = 0;
    StageSource source;
    /// Called for each stage after it was taken; may be empty.
    std::function<void(const LikelihoodRatio &ratio)> observer{};
};

/// Takes stages until a boundary, the cut-off stage or the last of `stages` is reached; then, if H1 was accepted,
/// estimates the trajectory (MapTrajectory). Throws Error, Cancelled.
SprtResult runSprt(const SequentialModel &model, const SprtSettings &settings, const StageSeries &stages,
                   const RunContext &context = {});
SprtResult runSprt(const SequentialModel &model, const SprtSettings &settings, Index stages, const StageSource &source,
                   const RunContext &context = {});

/// One look of a radar into one angular sector: a separate sequential test.
struct SectorVisit {
    Index round = 0;
    Index sector = 0;
    Index firstStage = 0; ///< stages the radar spent before this visit
    SprtResult result;
};

/// Rounds of looks and their cost.
struct SectorRounds {
    std::vector<SectorVisit> visits; ///< in chronological order
    Index stages = 0;                ///< total number
    Index fixedStages = 0;           ///< that a test of fixed size would have spent

    /// Fraction of the fixed-size test's stages that was saved; negative if more were needed.
    double saving() const { return fixedStages > 0 ? 1.0 - double(stages) / double(fixedStages) : 0.0; }
};

/// The stages of one look; they may depend on when it begins.
using SectorSource = std::function<StageSource(const SectorVisit &visit)>;

/// Number of visits and maximum length of a look.
struct SectorPlan {
    Index sectors = 1;
    Index rounds = 1;
    Index stagesAtMost = 1; ///< per look
    Index fixedSize = 1;    ///< stages per look of the fixed-size test for comparison
};

/// Visits sector after sector, round after round. Each look lasts until its test decides or `plan.stagesAtMost` stages
/// are taken (no decision). Empty sectors, the majority, are left early, which is where a sequential test saves stages
/// compared with one of `plan.fixedSize` stages per look. Source: Grossi and Lops 2006, section 4. Throws Error,
/// Cancelled.
SectorRounds visitSectors(const SequentialModel &model, const SprtSettings &settings, const SectorPlan &plan,
                          const SectorSource &source, const RunContext &context = {});

} // namespace faintline
