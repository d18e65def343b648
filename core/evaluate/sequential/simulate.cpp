#include "evaluate/sequential/simulate.h"

#include "base/Error.h"
#include "base/fastmath.h"
#include "base/multiversion.h"
#include "base/parallel.h"
#include "evaluate/sequential/SequentialTrial.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace faintline {

namespace {

    constexpr Index stageLimit = 1000000;
    constexpr Index trialsOfAnItem = 1000;

    struct SimulatedTrial {
        Index stages = 0;
        SprtDecision decision = SprtDecision::Undecided;
        double lambda = 1.0;
        bool isLastCorrect = false;
        bool isTrackCorrect = false;
    };

    FAINTLINE_MULTIVERSION
    void likelihoodRatios(const float *y, std::size_t n, float slope, float offset, float *ratio)
    {
        for (std::size_t i = 0; i < n; ++i)
            ratio[i] = fastExp(slope * y[i] + offset);
    }

    FAINTLINE_MULTIVERSION
    void addFolded(float *sum, const float *ratio, std::size_t n)
    {
        for (std::size_t i = 0; i < n; ++i)
            sum[i] += ratio[i];
    }

    /// For a trial's frame: Σ p1/p0 over the cells folded into one, in the first stateCells elements of `ratio`, which
    /// is as long as the frame.
    void foldedRatios(const SequentialModel &model, std::span<const float> y, std::span<float> ratio)
    {
        const double snr = model.markov.likelihood.snr();
        likelihoodRatios(y.data(), y.size(), float(snr / (1.0 + snr)), float(-std::log1p(snr)), ratio.data());
        const auto cells = std::size_t(model.reduction.stateCells());
        for (std::size_t other = cells; other < ratio.size(); other += cells)
            addFolded(ratio.data(), ratio.data() + other, cells);
    }

    /// weights = predicted · ratio of cells × lanes; total(lane) = Σ weights
    FAINTLINE_MULTIVERSION
    void weigh(const double *predicted, const double *ratio, Index cells, double *weights, std::span<double> total)
    {
        const Index lanes = std::ssize(total);
        for (Index cell = 0; cell < cells; ++cell)
            for (Index lane = 0; lane < lanes; ++lane) {
                const double weight = predicted[cell * lanes + lane] * ratio[cell * lanes + lane];
                weights[cell * lanes + lane] = weight;
                total[std::size_t(lane)] += weight;
            }
    }

    Index lanesFor(Index states)
    {
        if (states > 512)
            return 1;
        return states > 64 ? 32 : 64;
    }

    StateSpace withLanes(const StateSpace &space, Index lanes)
    {
        std::vector<KinematicAxis> axes = space.axes();
        KinematicAxis trials;
        trials.name = "trial";
        trials.cells = lanes;
        axes.push_back(trials);
        return StateSpace(std::move(axes));
    }

    void check(const SequentialStudy &study)
    {
        checkSprt(study.sprt, "sprt");
        study.model.check("model");
        if (study.model.observedEvery != 1)
            throw Error("model.observedEvery", "must be 1 if sequential tests are simulated, because their frames do "
                                               "not overlap");
        if (study.model.markov.likelihood.kind() != LikelihoodKind::Exponential)
            throw Error("model.likelihood", "must be exponential if sequential tests are simulated");
        if (study.actualSnr && !(*study.actualSnr > 0.0 && *study.actualSnr < 1e12))
            throw fieldError("actualSnr", formatNumber(*study.actualSnr), "must be a power ratio above 0");
        if (study.trials < 1)
            throw Error("trials", "must be at least 1");
        if (const Index row = study.model.markov.space.axes().back().cells;
            study.averagedCells < 0 || study.averagedCells >= row)
            throw Error("averagedCells", "must be less than the " + std::to_string(row) + " cells of the last axis");
    }

    /// Runs trials abreast in the lanes of one recursion.
    class Runner
    {
    public:
        Runner(const SequentialStudy &study, const TrajectorySampler &sampler)
            : m_study(study), m_sampler(sampler), m_cells(study.model.markov.space.cellCount()),
              m_states(study.model.markov.space.stateCount()), m_lanes(lanesFor(m_states)),
              m_initial(study.model.initialLaw()), m_recursion(withLanes(study.model.markov.space, m_lanes)),
              m_weights(std::size_t(m_states * m_lanes), 0.0), m_ratio(std::size_t(m_cells * m_lanes), 0.0),
              m_total(std::size_t(m_lanes)), m_cellRatio(std::size_t(study.model.reduction.frameCells())),
              m_slot(std::size_t(m_lanes))
        {
        }

        void run(Index first, Index count, SimulatedTrial *outcomes, const RunContext &context)
        {
            Index next = 0;
            Index running = 0;
            m_step = 0;
            const Index period = m_study.model.markov.space.phaseCount();
            for (Slot &slot : m_slot)
                slot.trial.reset();
            for (;;) {
                // A trial's moves are numbered from its own start, so it begins where those of all lanes repeat.
                for (std::size_t lane = 0; m_step % period == 0 && lane < m_slot.size() && next < count; ++lane) {
                    if (m_slot[lane].trial)
                        continue;
                    m_slot[lane] = {std::make_unique<SequentialTrial>(m_study, m_sampler, first + next), next, 0};
                    ++next;
                    ++running;
                }
                if (running == 0 && next == count)
                    return;
                if (context.stop.stop_requested())
                    throw Cancelled();
                stage();
                for (std::size_t lane = 0; lane < m_slot.size(); ++lane)
                    running -= m_slot[lane].trial && settle(lane, outcomes) ? 1 : 0;
            }
        }

    private:
        struct Slot {
            std::unique_ptr<SequentialTrial> trial;
            Index number = 0;
            Index stages = 0;
        };

        void stage()
        {
            for (std::size_t lane = 0; lane < m_slot.size(); ++lane)
                if (m_slot[lane].trial)
                    takeFrame(lane);
            const std::span<double> predicted = m_recursion.predict(m_weights, m_step++);
            for (std::size_t lane = 0; lane < m_slot.size(); ++lane)
                if (m_slot[lane].trial && m_slot[lane].stages++ == 0)
                    for (std::size_t n = 0; n < m_initial.size(); ++n)
                        predicted[n * m_slot.size() + lane] = m_initial[n];
            std::fill(m_total.begin(), m_total.end(), 0.0);
            for (Index plane = 0; plane < m_states / m_cells; ++plane) {
                const Index offset = plane * m_cells * m_lanes;
                weigh(predicted.data() + offset, m_ratio.data(), m_cells, m_weights.data() + offset, m_total);
            }
        }

        void takeFrame(std::size_t lane)
        {
            foldedRatios(m_study.model, m_slot[lane].trial->next(), m_cellRatio);
            const auto cells = std::size_t(m_cells);
            const double share = double(m_cells) / double(m_cellRatio.size());
            for (std::size_t cell = 0; cell < cells; ++cell)
                m_ratio[cell * m_slot.size() + lane] = share * double(m_cellRatio[cell]);
        }

        /// Whether the lane's trial is over; its outcome is written and its lane cleared then.
        bool settle(std::size_t lane, SimulatedTrial *outcomes)
        {
            Slot &slot = m_slot[lane];
            const double lambda = m_total[lane];
            const SprtDecision decision = decide(m_study.sprt, std::log(lambda), slot.stages);
            if (decision == SprtDecision::Undecided && slot.stages < stageLimit)
                return false;
            SimulatedTrial &outcome = outcomes[slot.number];
            outcome.stages = slot.stages;
            outcome.decision = decision;
            outcome.lambda = lambda;
            slot.trial.reset();
            for (std::size_t n = 0; n < m_initial.size(); ++n)
                m_weights[n * m_slot.size() + lane] = 0.0;
            for (std::size_t cell = 0; cell < std::size_t(m_cells); ++cell)
                m_ratio[cell * m_slot.size() + lane] = 0.0;
            return true;
        }

        const SequentialStudy &m_study;
        const TrajectorySampler &m_sampler;
        Index m_cells;
        Index m_states;
        Index m_lanes;
        Index m_step = 0;
        std::vector<double> m_initial;
        Recursion<SumProduct> m_recursion;
        std::vector<double> m_weights;
        std::vector<double> m_ratio;
        std::vector<double> m_total;
        std::vector<float> m_cellRatio;
        std::vector<Slot> m_slot;
    };

    Estimate meanOf(double sum, double sumOfSquares, double n)
    {
        const double mean = sum / n;
        return {mean, n > 1.0 ? std::sqrt(std::max(0.0, sumOfSquares / n - mean * mean) / (n - 1.0)) : 0.0};
    }

    /// Mean, deviation, and coefficient of variation with its standard error by the delta method.
    void summariseStages(const std::vector<SimulatedTrial> &outcomes, SequentialOutcome &result)
    {
        const auto n = double(outcomes.size());
        double mean = 0.0;
        for (const SimulatedTrial &o : outcomes)
            mean += double(o.stages) / n;
        double m2 = 0.0;
        double m3 = 0.0;
        double m4 = 0.0;
        for (const SimulatedTrial &o : outcomes) {
            const double d = double(o.stages) - mean;
            m2 += d * d / n;
            m3 += d * d * d / n;
            m4 += d * d * d * d / n;
        }
        result.deviationStages = std::sqrt(m2);
        result.stages = {mean, std::sqrt(m2 / n)};
        const double variation = result.deviationStages / mean;
        const double relative =
            m2 > 0.0 ? (m4 - m2 * m2) / (4.0 * m2 * m2) + m2 / (mean * mean) - m3 / (m2 * mean) : 0.0;
        result.variation = {variation, variation * std::sqrt(std::max(0.0, relative) / n)};
    }

    SequentialOutcome summarise(const SequentialStudy &study, const std::vector<SimulatedTrial> &outcomes)
    {
        SequentialOutcome result;
        result.trials = study.trials;
        double sum = 0.0;
        double sumOfSquares = 0.0;
        for (const SimulatedTrial &o : outcomes) {
            result.acceptedH1 += o.decision == SprtDecision::H1 ? 1 : 0;
            result.undecided += o.decision == SprtDecision::Undecided ? 1 : 0;
            result.correctLast += o.isLastCorrect ? 1 : 0;
            result.correctTrack += o.isTrackCorrect ? 1 : 0;
            const bool isOther = o.decision == (study.actualSnr ? SprtDecision::H1 : SprtDecision::H0);
            const double error = !isOther ? 0.0 : study.actualSnr ? 1.0 / o.lambda : o.lambda;
            sum += error;
            sumOfSquares += error * error;
            if (o.stages > std::ssize(result.stopCounts))
                result.stopCounts.resize(std::size_t(o.stages), 0);
            ++result.stopCounts[std::size_t(o.stages - 1)];
        }
        summariseStages(outcomes, result);
        result.otherError = meanOf(sum, sumOfSquares, double(outcomes.size()));
        return result;
    }

    /// ln Λ of every trial after every one of `largest` stages, stage by stage.
    std::vector<double> lnRatios(const SequentialStudy &study, Index largest, const RunContext &context)
    {
        const TrajectorySampler sampler(study.model);
        const auto trials = std::size_t(study.trials);
        std::vector<double> lnLambda(trials * std::size_t(largest));
        parallelFor(study.trials, context, "fixed-size tests", [&]() -> std::function<void(Index)> {
            return [&](Index trial) {
                SequentialTrial run(study, sampler, trial);
                LikelihoodRatio ratio(study.model);
                std::vector<float> cellRatio(std::size_t(study.model.reduction.frameCells()));
                std::vector<double> lambda(std::size_t(study.model.reduction.stateCells()));
                const double lnFolded = std::log(double(study.model.reduction.foldedCells()));
                for (Index stage = 0; stage < largest; ++stage) {
                    foldedRatios(study.model, run.next(), cellRatio);
                    for (std::size_t cell = 0; cell < lambda.size(); ++cell)
                        lambda[cell] = std::log(double(cellRatio[cell])) - lnFolded;
                    lnLambda[std::size_t(stage) * trials + std::size_t(trial)] = ratio.update(lambda);
                }
            };
        });
        return lnLambda;
    }

    /// Whether a threshold exists that misses no more than β of these runs with a target and accepts no more than α of
    /// noise, by change of measure. Sorts them.
    bool suffices(std::span<double> lnLambda, const SprtSettings &sprt)
    {
        std::sort(lnLambda.begin(), lnLambda.end());
        const auto missed = std::size_t(sprt.miss * double(lnLambda.size()));
        double falseAlarm = 0.0;
        for (std::size_t i = lnLambda.size(); i-- > missed;)
            falseAlarm += std::exp(-lnLambda[i]) / double(lnLambda.size());
        return falseAlarm <= sprt.falseAlarm;
    }

} // namespace

SequentialOutcome simulate(const SequentialStudy &study, const RunContext &context)
{
    check(study);
    const TrajectorySampler sampler(study.model);
    std::vector<SimulatedTrial> outcomes(std::size_t(study.trials));
    const Index items = (study.trials + trialsOfAnItem - 1) / trialsOfAnItem;
    parallelFor(items, context, "sequential tests", [&]() -> std::function<void(Index)> {
        const auto runner = std::make_shared<Runner>(study, sampler);
        const auto judge =
            study.estimatesTrajectory && study.actualSnr ? std::make_shared<TrajectoryJudge>(study, sampler) : nullptr;
        return [&, runner, judge](Index item) {
            const Index first = item * trialsOfAnItem;
            const Index count = std::min(trialsOfAnItem, study.trials - first);
            SimulatedTrial *own = outcomes.data() + first;
            runner->run(first, count, own, context);
            for (Index i = 0; judge && i < count; ++i)
                if (own[i].decision == SprtDecision::H1) {
                    const TrajectoryJudge::Errors errors = judge->errorsOf(first + i, own[i].stages);
                    own[i].isLastCorrect = errors.last <= study.lastWithinCells;
                    own[i].isTrackCorrect = errors.largest <= study.trackWithinCells;
                }
        };
    });
    return summarise(study, outcomes);
}

std::optional<Index> simulatedFixedSampleSize(const SequentialStudy &study, Index largest, const RunContext &context)
{
    check(study);
    SequentialStudy own = study;
    own.actualSnr = study.model.markov.likelihood.snr();
    // Few stages first: most of the work lies in those beyond the answer.
    Index known = 0;
    for (Index count = std::min<Index>(largest, 8); known < largest; count = std::min(largest, 2 * count)) {
        const double done = double(known) / double(largest);
        std::vector<double> lnLambda = lnRatios(own, count, context.part(done, double(count) / double(largest)));
        for (Index stage = known; stage < count; ++stage)
            if (suffices(std::span(lnLambda).subspan(std::size_t(stage * own.trials), std::size_t(own.trials)),
                         own.sprt))
                return stage + 1;
        known = count;
    }
    return std::nullopt;
}

} // namespace faintline
