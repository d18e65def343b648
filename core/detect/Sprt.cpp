#include "detect/Sprt.h"

#include "base/Error.h"
#include "base/json.h"
#include "base/logmath.h"
#include "detect/MapTrajectory.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace faintline {

const std::vector<Field<SprtSettings>> &SprtSettings::fields()
{
    using S = SprtSettings;
    static const std::vector<Field<S>> table{
        field(&S::falseAlarm, "falseAlarm", "", 1e-300, 0.5, "Specified probability of accepting a signal on noise, α.")
            .labelled("False alarms α")
            .advised("Lower it for fewer false alarms: the duration of the test on a signal grows with ln 1/α. Source: "
                     "Wald 1945."),
        field(&S::miss, "miss", "", 1e-300, 0.5, "Specified probability of accepting noise with a signal, β.")
            .labelled("Misses β")
            .advised(
                "Lower it for fewer misses: the duration of the test on noise grows with ln 1/β. Source: Wald 1945."),
        field(&S::cutOffStage, "cutOffStage", "", 0.0, 1e9, "Stage at which a decision is forced; 0: never.")
            .labelled("Cut-off stage")
            .advised("Use it to limit the duration of a test. An early cut-off raises both error probabilities."),
    };
    return table;
}

void checkSprt(const SprtSettings &settings, const std::string &where)
{
    checkFields(settings, SprtSettings::fields(), where);
    if (!(settings.falseAlarm + settings.miss < 1.0))
        throw Error(where, "falseAlarm + miss must be below 1, the value of a random decision");
}

SprtBoundaries sprtBoundaries(const SprtSettings &settings)
{
    return {std::log(settings.miss) - std::log1p(-settings.falseAlarm),
            std::log1p(-settings.miss) - std::log(settings.falseAlarm)};
}

SprtDecision decide(const SprtSettings &settings, double lnLambda, Index stage)
{
    const SprtBoundaries at = sprtBoundaries(settings);
    if (lnLambda >= at.lnUpper)
        return SprtDecision::H1;
    if (lnLambda <= at.lnLower)
        return SprtDecision::H0;
    if (settings.cutOffStage > 0 && stage >= settings.cutOffStage)
        return lnLambda >= at.lnCutOff() ? SprtDecision::H1 : SprtDecision::H0;
    return SprtDecision::Undecided;
}

LikelihoodRatio::LikelihoodRatio(const SequentialModel &model)
    : m_cells(model.markov.space.cellCount()), m_initial(model.initialLaw()),
      m_recursion(model.markov.space, model.markov.transitionScale), m_posterior(m_initial)
{
}

double LikelihoodRatio::update(std::span<const double> lambda)
{
    const auto cells = std::size_t(m_cells);
    const std::span<const double> predicted =
        m_stages == 0 ? std::span<const double>(m_initial) : m_recursion.predict(m_posterior, m_stages);
    ++m_stages;
    double highest = minusInfinity; // among reachable cells: others must not cause an underflow of these
    for (std::size_t n = 0; n < predicted.size(); ++n)
        if (predicted[n] > 0.0)
            highest = std::max(highest, lambda[n % cells]);
    if (highest == minusInfinity) { // all of the target's probability has left the axes
        m_lnLambda = minusInfinity;
        std::fill(m_posterior.begin(), m_posterior.end(), 0.0);
        return m_lnLambda;
    }
    for (std::size_t n = 0; n < predicted.size(); ++n)
        m_posterior[n] = predicted[n] > 0.0 ? predicted[n] * std::exp(lambda[n % cells] - highest) : 0.0;
    const double total = std::accumulate(m_posterior.begin(), m_posterior.end(), 0.0);
    for (double &p : m_posterior)
        p /= total;
    m_lnLambda += highest + std::log(total);
    return m_lnLambda;
}

namespace {

    /// λ of each frame cell, stage by stage.
    class Evidence
    {
    public:
        Evidence(const SequentialModel &model, const StageSource &source)
            : m_model(model), m_source(source), m_lambda(std::size_t(model.reduction.frameCells()))
        {
        }

        std::span<const double> at(Index stage)
        {
            if (stage % m_model.observedEvery != 0) {
                std::fill(m_lambda.begin(), m_lambda.end(), 0.0);
                return m_lambda;
            }
            m_source(stage, m_lambda);
            for (double &value : m_lambda)
                value = m_model.markov.likelihood.at(value);
            return m_lambda;
        }

    private:
        const SequentialModel &m_model;
        const StageSource &m_source;
        std::vector<double> m_lambda;
    };

} // namespace

SprtResult runSprt(const SequentialModel &model, const SprtSettings &settings, Index stages, const StageSource &source,
                   const RunContext &context)
{
    return runSprt(model, settings, {stages, source}, context);
}

SprtResult runSprt(const SequentialModel &model, const SprtSettings &settings, const StageSeries &stages,
                   const RunContext &context)
{
    checkSprt(settings, "sprt");
    model.check("model");
    Evidence evidence(model, stages.source);
    LikelihoodRatio ratio(model);
    std::vector<double> folded(std::size_t(model.reduction.stateCells()));
    SprtResult result;
    const Index last = settings.cutOffStage > 0 ? std::min<Index>(stages.count, settings.cutOffStage) : stages.count;
    while (result.stages < last && result.decision == SprtDecision::Undecided) {
        context.checkpoint(0.5 * double(result.stages) / double(last), "sequential test");
        model.reduction.sum(evidence.at(result.stages), folded);
        result.lnLambda.push_back(ratio.update(folded));
        ++result.stages;
        if (stages.observer)
            stages.observer(ratio);
        result.decision = decide(settings, result.lnLambda.back(), result.stages);
    }
    if (result.decision == SprtDecision::Undecided)
        return result;
    const SprtBoundaries boundaries = sprtBoundaries(settings);
    result.isForced = result.lnLambda.back() < boundaries.lnUpper && result.lnLambda.back() > boundaries.lnLower;
    if (result.decision != SprtDecision::H1)
        return result;

    const MapTrajectory map = MapEstimator(model).estimate(
        result.stages, [&](Index stage, std::span<double> out) { model.reduction.maximum(evidence.at(stage), out); },
        context.part(0.5, 1.0));
    result.lnMapScore = map.lnScore;
    for (Index stage = 0; stage < result.stages; ++stage)
        result.trajectory.push_back(
            model.reduction.best(evidence.at(stage), model.markov.space.cellOf(map.states[std::size_t(stage)])));
    return result;
}

SectorRounds visitSectors(const SequentialModel &model, const SprtSettings &settings, const SectorPlan &plan,
                          const SectorSource &source, const RunContext &context)
{
    SectorRounds made;
    const Index looks = plan.sectors * plan.rounds;
    for (Index look = 0; look < looks; ++look) {
        SectorVisit visit{look / plan.sectors, look % plan.sectors, made.stages, {}};
        const auto count = double(looks);
        visit.result = runSprt(model, settings, plan.stagesAtMost, source(visit),
                               context.part(double(look) / count, double(look + 1) / count));
        made.stages += visit.result.stages;
        made.fixedStages += plan.fixedSize;
        made.visits.push_back(std::move(visit));
    }
    return made;
}

} // namespace faintline
