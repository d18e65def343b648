#include "recursion/ForwardBackward.h"

#include "base/logmath.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// All moves of one phase, by target state.
    struct Moves {
        struct StateMove {
            Index from;
            Index to;
            double lnProbability;
        };
        std::vector<StateMove> moves;
    };

    Moves movesOf(const StateSpace &space, Index phase)
    {
        constexpr std::size_t transitionLimit = std::size_t(1) << 27;
        Moves result;
        for (Index n = 0; n < space.stateCount(); ++n) {
            for (const StateSpace::Predecessor &p : space.predecessors(n, phase))
                result.moves.push_back({p.state, n, p.lnProbability});
            if (result.moves.size() > transitionLimit)
                throw Error("law", "gives more than 2²⁷ transitions per frame; use fewer cells or rates");
        }
        return result;
    }

    /// Accumulates ln Σ in `into`, one term per move: `term(move)` goes to state `place(move)`.
    template <class Place, class Term>
    void gather(const Moves &moves, std::span<double> into, const Place &place, const Term &term)
    {
        std::vector<double> largest(into.size(), minusInfinity);
        for (const Moves::StateMove &move : moves.moves) {
            double &most = largest[std::size_t(place(move))];
            most = std::max(most, term(move));
        }
        std::fill(into.begin(), into.end(), 0.0);
        for (const Moves::StateMove &move : moves.moves)
            if (const double most = largest[std::size_t(place(move))]; most > minusInfinity)
                into[std::size_t(place(move))] += std::exp(term(move) - most);
        for (std::size_t n = 0; n < into.size(); ++n)
            into[n] = into[n] > 0.0 ? std::log(into[n]) + largest[n] : minusInfinity;
    }

    /// ln Σ e^ln.
    double lnSumOf(std::span<const double> ln)
    {
        const double largest = *std::max_element(ln.begin(), ln.end());
        if (!(largest > minusInfinity))
            return largest;
        double sum = 0.0;
        for (const double value : ln)
            sum += std::exp(value - largest);
        return std::log(sum) + largest;
    }

    void addEvidence(std::span<double> ln, std::span<const double> lambda)
    {
        for (std::size_t n = 0; n < ln.size(); ++n)
            ln[n] += lambda[n % lambda.size()];
    }

    void becomeProbabilities(std::span<double> ln)
    {
        const double lnSum = lnSumOf(ln);
        for (double &value : ln)
            value = std::exp(value - lnSum);
    }

    /// Forward and backward pass through one stack of frames.
    class Pass
    {
    public:
        Pass(const StateSpace &space, std::span<const double> lambda, const RunContext &context)
            : m_states(std::size_t(space.stateCount())), m_cells(std::size_t(space.cellCount())),
              m_frames(lambda.size() / m_cells), m_lambda(lambda)
        {
            for (Index phase = 0; phase < std::min(space.phaseCount(), Index(m_frames)); ++phase) {
                context.checkpoint(0.0, "moves");
                m_phases.push_back(movesOf(space, phase));
            }
            m_values.resize(m_frames * m_states);
        }

        double forward(std::span<const double> initial, const RunContext &context)
        {
            for (std::size_t t = 0; t < m_frames; ++t) {
                context.checkpoint(double(t) / double(m_frames), "forward");
                const std::span<double> now = frame(t);
                if (t > 0) {
                    const std::span<const double> past = frame(t - 1);
                    gather(
                        movesInto(t), now, [](const auto &move) { return move.to; },
                        [past](const auto &move) { return past[std::size_t(move.from)] + move.lnProbability; });
                } else {
                    for (std::size_t n = 0; n < m_states; ++n)
                        now[n] = initial.empty() ? -std::log(double(m_states)) : std::log(initial[n]);
                }
                addEvidence(now, lambda(t));
            }
            const double lnEvidence = lnSumOf(frame(m_frames - 1));
            if (!(lnEvidence > minusInfinity))
                throw Error("log-likelihoods and law", "leave no path with a probability above 0");
            return lnEvidence;
        }

        /// Converts the result of the forward pass to the posterior.
        void backward(const RunContext &context)
        {
            std::vector<double> beta(m_states, 0.0);
            std::vector<double> before(m_states);
            becomeProbabilities(frame(m_frames - 1));
            for (std::size_t t = m_frames - 1; t > 0; --t) {
                context.checkpoint(1.0 - double(t) / double(m_frames), "backward");
                addEvidence(beta, lambda(t));
                gather(
                    movesInto(t), before, [](const auto &move) { return move.from; },
                    [&beta](const auto &move) { return beta[std::size_t(move.to)] + move.lnProbability; });
                std::swap(beta, before);
                const std::span<double> now = frame(t - 1);
                for (std::size_t n = 0; n < m_states; ++n)
                    now[n] += beta[n];
                becomeProbabilities(now);
            }
        }

        std::vector<double> take() { return std::move(m_values); }

    private:
        const Moves &movesInto(std::size_t t) const { return m_phases[t % m_phases.size()]; }
        std::span<double> frame(std::size_t t) { return std::span(m_values).subspan(t * m_states, m_states); }
        std::span<const double> lambda(std::size_t t) const { return m_lambda.subspan(t * m_cells, m_cells); }

        std::size_t m_states;
        std::size_t m_cells;
        std::size_t m_frames;
        std::span<const double> m_lambda;
        std::vector<Moves> m_phases;
        std::vector<double> m_values; ///< ln α, then γ
    };

} // namespace

Posterior forwardBackward(const StateSpace &space, std::span<const double> initial, std::span<const double> lambda,
                          const RunContext &context)
{
    Posterior posterior;
    Pass pass(space, lambda, context);
    posterior.lnEvidence = pass.forward(initial, context.part(0.0, 0.5));
    pass.backward(context.part(0.5, 1.0));
    posterior.probability = pass.take();
    return posterior;
}

} // namespace faintline
