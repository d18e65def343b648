#include "recursion/presence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr double lowQuantile = 0.05;
    constexpr double highQuantile = 0.95;
    constexpr Index chunkMinimumBytes = Index(1) << 21;
    constexpr double lambdaLimitNats = 60.0; ///< larger values would not change a decision

    /// Probabilities of the states after a frame: rates × width, followed by "off".
    using Weights = std::vector<double>;

    struct Step {
        Index from; ///< plane offset, states
        Index to;
        Index cells;
        double probability;
        double lnProbability;
    };

    /// Calls take(from, to, move) for each transition from a corridor's cells in one frame to those in the next; the
    /// corridors are displaced by the path's motion.
    template <class Take>
    void forEachWay(const Corridor &corridor, const std::vector<Step> &steps, Index frame, Take take)
    {
        const auto at = std::size_t(frame);
        const Index drift = corridor.firstCells[at] - corridor.firstCells[at - 1];
        for (const Step &step : steps) {
            const Index shift = step.cells - drift; // target cell - source cell, in the corridors' numbering
            const Index last = std::min(corridor.width, corridor.width + shift);
            for (Index to = std::max<Index>(0, shift); to < last; ++to)
                take(step.from + to - shift, step.to + to, step);
        }
    }

    /// The moves of each phase between planes of a corridor.
    std::vector<std::vector<Step>> stepsOf(const KinematicAxis &axis, Index width)
    {
        std::vector<std::vector<Step>> steps;
        for (Index phase = 0; phase < axis.phaseCount(); ++phase) {
            steps.emplace_back();
            for (const KinematicAxis::Move &move : axis.moves(phase))
                steps.back().push_back({move.fromRate * width, move.toRate * width, move.cells,
                                        std::exp(move.lnProbability), move.lnProbability});
        }
        return steps;
    }

    class Chain
    {
    public:
        Chain(const Corridor &corridor, const KinematicAxis &axis, double lnChange, Index firstStep)
            : m_corridor(corridor), m_width(corridor.width), m_rates(axis.rateCount), m_states(m_width * m_rates),
              m_change(std::exp(lnChange)), m_birth(m_change / double(m_states)), m_firstStep(firstStep),
              m_steps(stepsOf(axis, corridor.width))
        {
        }

        Index states() const { return m_states; }

        /// Before the first frame.
        Weights start(bool isAbsent) const
        {
            const double on = isAbsent ? m_change : 0.5;
            Weights weights(std::size_t(m_states) + 1, on / double(m_states));
            weights.back() = 1.0 - on;
            return weights;
        }

        /// β of the last frame.
        Weights end(bool isAbsent) const
        {
            Weights weights(std::size_t(m_states) + 1, isAbsent ? m_change : 1.0);
            weights.back() = isAbsent ? 1.0 - m_change : 1.0;
            return weights;
        }

        /// Computes α of a frame from the previous one, scaled to a sum of 1.
        Weights forward(const Weights &before, Index frame) const
        {
            Weights after(before.size(), m_birth * before.back());
            if (frame == 0)
                std::fill(after.begin(), after.end(), before.front());
            else
                forEachMove(frame, [&](Index from, Index to, double p) {
                    after[std::size_t(to)] += p * before[std::size_t(from)];
                });
            double on = 0.0;
            for (std::size_t s = 0; s + 1 < before.size(); ++s)
                on += before[s];
            after.back() = frame == 0 ? before.back() : (1.0 - m_change) * before.back() + m_change * on;
            applyEvidence(frame, after);
            scale(after);
            return after;
        }

        /// Computes β of a frame from the next one.
        Weights backward(Weights next, Index nextFrame) const
        {
            applyEvidence(nextFrame, next);
            double births = 0.0;
            for (std::size_t s = 0; s + 1 < next.size(); ++s)
                births += next[s];
            Weights before(next.size(), m_change * next.back());
            forEachMove(nextFrame, [&](Index from, Index to, double p) {
                before[std::size_t(from)] += p * next[std::size_t(to)];
            });
            before.back() = (1.0 - m_change) * next.back() + m_birth * births;
            scale(before);
            return before;
        }

        void addTo(Presence &result, const Weights &alpha, const Weights &beta, Index frame) const
        {
            std::vector<double> cells(static_cast<std::size_t>(m_width));
            for (std::size_t first = 0; first < std::size_t(m_states); first += cells.size())
                for (std::size_t c = 0; c < cells.size(); ++c)
                    cells[c] += alpha[first + c] * beta[first + c];
            const double off = alpha.back() * beta.back();
            double on = 0.0;
            double moment = 0.0;
            for (std::size_t c = 0; c < cells.size(); ++c) {
                on += cells[c];
                moment += cells[c] * double(c);
            }
            const auto lowest = double(m_corridor.firstCells[std::size_t(frame)]);
            const auto at = std::size_t(frame);
            result.present[at] = float(on + off > 0.0 ? on / (on + off) : 0.0);
            result.mean[at] = lowest + (on > 0.0 ? moment / on : 0.5 * double(m_width - 1));
            result.low[at] = float(lowest + quantile(cells, lowQuantile * on));
            result.high[at] = float(lowest + quantile(cells, highQuantile * on));
        }

        /// Adds the probabilities that the slope changed by 0, 1, … steps in the step into that frame.
        void addChangesTo(std::vector<double> &changes, const Weights &before, Weights next, Index frame) const
        {
            applyEvidence(frame, next);
            double on = 0.0;
            double arrivals = 0.0;
            for (std::size_t s = 0; s + 1 < next.size(); ++s) {
                on += before[s];
                arrivals += next[s];
            }
            double all =
                before.back() * ((1.0 - m_change) * next.back() + m_birth * arrivals) + on * m_change * next.back();
            std::vector<double> found(changes.size());
            forEachWay(m_corridor, stepsInto(frame), frame, [&](Index from, Index to, const Step &step) {
                const double weight = before[std::size_t(from)] * step.probability * next[std::size_t(to)];
                found[std::size_t(std::abs(step.to - step.from) / m_width)] += weight;
                all += weight;
            });
            for (std::size_t i = 0; i < changes.size() && all > 0.0; ++i)
                changes[i] += found[i] / all;
        }

    private:
        const std::vector<Step> &stepsInto(Index frame) const
        {
            return m_steps[std::size_t((m_firstStep + frame) % Index(m_steps.size()))];
        }

        template <class Take>
        void forEachMove(Index frame, Take take) const
        {
            forEachWay(m_corridor, stepsInto(frame), frame,
                       [&](Index from, Index to, const Step &step) { take(from, to, step.probability); });
        }

        void applyEvidence(Index frame, Weights &weights) const
        {
            const float *lambda = m_corridor.lambda.data() + frame * m_width;
            double largest = 0.0;
            for (Index c = 0; c < m_width; ++c)
                largest = std::max(largest, std::min(lambdaLimitNats, double(lambda[c])));
            for (Index c = 0; c < m_width; ++c) {
                const double factor = std::exp(std::min(lambdaLimitNats, double(lambda[c])) - largest);
                for (Index s = c; s < m_states; s += m_width)
                    weights[std::size_t(s)] *= factor;
            }
            weights.back() *= std::exp(-largest);
        }

        static void scale(Weights &weights)
        {
            double sum = 0.0;
            for (const double w : weights)
                sum += w;
            if (sum > 0.0)
                for (double &w : weights)
                    w /= sum;
        }

        /// Position at which the cumulative sum from the lowest cell's lower edge reaches `sum`.
        static double quantile(const std::vector<double> &cells, double sum)
        {
            double before = 0.0;
            for (std::size_t c = 0; c < cells.size(); ++c) {
                if (before + cells[c] >= sum && cells[c] > 0.0)
                    return double(c) - 0.5 + (sum - before) / cells[c];
                before += cells[c];
            }
            return 0.5 * double(cells.size() - 1);
        }

        const Corridor &m_corridor;
        Index m_width;
        Index m_rates;
        Index m_states;
        double m_change;
        double m_birth; ///< into each state
        Index m_firstStep;
        std::vector<std::vector<Step>> m_steps; ///< of each phase
    };

    /// Calls take(frame, α of the previous frame, α, β) for each frame, the last one first.
    template <class Take>
    void passBothWays(const Chain &chain, Index frames, CorridorEnds ends, Take take)
    {
        // α at the beginning of each chunk; inside a chunk it is computed on the way back, again in all but the last.
        const auto chunk = std::max<Index>(chunkMinimumBytes / (Index(sizeof(double)) * (chain.states() + 1)),
                                           Index(std::sqrt(double(frames))) + 1);
        std::vector<Weights> starts{chain.start(ends.absentBefore)};
        for (Index first = chunk; first < frames; first += chunk) {
            Weights alpha = starts.back();
            for (Index frame = first - chunk; frame < first; ++frame)
                alpha = chain.forward(alpha, frame);
            starts.push_back(std::move(alpha));
        }
        Weights beta = chain.end(ends.absentAfter);
        for (Index first = (std::ssize(starts) - 1) * chunk; first >= 0; first -= chunk) {
            const Index end = std::min(frames, first + chunk);
            std::vector<Weights> alphas{starts[std::size_t(first / chunk)]};
            for (Index frame = first; frame < end; ++frame)
                alphas.push_back(chain.forward(alphas.back(), frame));
            for (Index frame = end; frame-- > first;) {
                const auto at = std::size_t(frame - first);
                take(frame, alphas[at], alphas[at + 1], beta);
                if (frame > 0)
                    beta = chain.backward(std::move(beta), frame);
            }
        }
    }

} // namespace

Presence presenceIn(const Corridor &corridor, const KinematicAxis &axis, double lnChange, Index firstStep,
                    CorridorEnds ends)
{
    const Chain chain(corridor, axis, lnChange, firstStep);
    const auto count = std::size_t(corridor.frameCount());
    Presence result{std::vector<float>(count), std::vector<double>(count), std::vector<float>(count),
                    std::vector<float>(count)};
    passBothWays(chain, corridor.frameCount(), ends,
                 [&](Index frame, const Weights &, const Weights &alpha, const Weights &beta) {
                     chain.addTo(result, alpha, beta, frame);
                 });
    return result;
}

std::vector<double> expectedSlopeChanges(const Corridor &corridor, const KinematicAxis &axis, double lnChange,
                                         Index firstStep)
{
    const Chain chain(corridor, axis, lnChange, firstStep);
    std::vector<double> changes(axis.rateChange.size());
    passBothWays(chain, corridor.frameCount(), {},
                 [&](Index frame, const Weights &before, const Weights &, const Weights &beta) {
                     if (frame > 0)
                         chain.addChangesTo(changes, before, beta, frame);
                 });
    return changes;
}

double strongestPath(const Corridor &corridor, const KinematicAxis &axis, const std::vector<double> &lnK,
                     Index firstStep)
{
    const auto steps = stepsOf(axis, corridor.width);
    const auto states = std::size_t(corridor.width * axis.rateCount);
    constexpr double nowhere = -std::numeric_limits<double>::infinity();
    std::vector<double> scores(states, nowhere);
    std::vector<double> next;
    double largest = nowhere;
    for (Index frame = 0; frame < corridor.frameCount(); ++frame) {
        next.assign(states, nowhere);
        if (frame > 0)
            forEachWay(corridor, steps[std::size_t((firstStep + frame) % std::ssize(steps))], frame,
                       [&](Index from, Index to, const Step &step) {
                           double &best = next[std::size_t(to)];
                           best = std::max(best, scores[std::size_t(from)] + step.lnProbability);
                       });
        const float *lambda = corridor.lambda.data() + frame * corridor.width;
        for (std::size_t first = 0; first < states; first += std::size_t(corridor.width))
            for (std::size_t c = 0; c < std::size_t(corridor.width); ++c) {
                double &score = next[first + c];
                score = std::max(0.0, score + lnK[std::size_t(frame)]) + double(lambda[c]);
                largest = std::max(largest, score);
            }
        std::swap(scores, next);
    }
    return largest;
}

} // namespace faintline
