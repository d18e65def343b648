#include "detect/Smd.h"

#include "base/multiversion.h"

#include <algorithm>
#include <limits>

namespace faintline {

namespace {

    constexpr float unreached = -std::numeric_limits<float>::infinity();

    /// u = λ + max(M + ln K, floor); D = max(D, u); answers how many went on.
    FAINTLINE_MULTIVERSION
    int joinReset(const float *predicted, const float *lambda, float lnK, Index n, float *scores, float *statistic)
    {
        int continued = 0;
        for (Index i = 0; i < n; ++i) {
            const float going = predicted[i] + lnK;
            continued += going > 0.0f ? 1 : 0;
            const float score = lambda[i] + (going > 0.0f ? going : 0.0f);
            scores[i] = score;
            statistic[i] = score > statistic[i] ? score : statistic[i];
        }
        return continued;
    }

    FAINTLINE_MULTIVERSION
    void joinNothing(const float *predicted, const float *lambda, float lnK, Index n, float *scores, float *statistic)
    {
        for (Index i = 0; i < n; ++i) {
            const float score = lambda[i] + (predicted[i] + lnK);
            scores[i] = score;
            statistic[i] = score > statistic[i] ? score : statistic[i];
        }
    }

    /// Σ max(M + ln K, 0) in a fixed order, so that the bits do not depend on the vector width: partial sums of a few values
    /// each in single precision, the rest in double.
    FAINTLINE_MULTIVERSION
    double sumContinued(const float *predicted, float lnK, Index n)
    {
        constexpr Index lanes = 16;
        constexpr Index run = 8 * lanes;
        double total[lanes] = {};
        Index i = 0;
        for (; i + run <= n; i += run) {
            float partial[lanes] = {};
            for (Index j = 0; j < run; j += lanes)
                for (Index lane = 0; lane < lanes; ++lane) {
                    const float going = predicted[i + j + lane] + lnK;
                    partial[lane] += going > 0.0f ? going : 0.0f;
                }
            for (Index lane = 0; lane < lanes; ++lane)
                total[lane] += static_cast<double>(partial[lane]);
        }
        double sum = 0.0;
        for (; i < n; ++i) {
            const float going = predicted[i] + lnK;
            sum += going > 0.0f ? static_cast<double>(going) : 0.0;
        }
        for (double lane : total)
            sum += lane;
        return sum;
    }

} // namespace

Smd::Smd(const MarkovModel &model, const ResetRule &rule)
    : m_space(model.space), m_likelihood(model.likelihood), m_rule(rule), m_recursion(model.space, model.transitionScale),
      m_scores(static_cast<std::size_t>(model.space.stateCount())), m_next(m_scores.size()),
      m_lambda(static_cast<std::size_t>(model.space.cellCount())),
      m_lnK(rule.law == ResetLaw::Fixed || rule.law == ResetLaw::Half ? rule.lnK : 0.0)
{
}

void Smd::update(std::span<const float> y, std::span<float> statistic)
{
    const Index cells = m_space.cellCount();
    const Index planes = m_space.planeCount();
    m_likelihood.apply(y, m_lambda);
    if (m_isFirst) {
        for (Index plane = 0; plane < planes; ++plane)
            std::copy(m_lambda.begin(), m_lambda.end(), m_scores.begin() + plane * cells);
        std::copy(m_lambda.begin(), m_lambda.end(), statistic.begin());
        m_isFirst = false;
        m_regulation = {m_lnK, 0.0, m_lnK};
        if (m_rule.law == ResetLaw::Mean) {
            // W(0) = 0 everywhere, so K(0) = K0.
            m_offset = m_rule.k0;
            m_lnK = m_offset;
            m_regulation.lnK = m_offset;
            for (float &value : statistic)
                value += static_cast<float>(m_offset);
        }
        return;
    }

    const auto lnK = static_cast<float>(m_lnK);
    std::fill(statistic.begin(), statistic.end(), unreached);
    Continued all;
    m_recursion.predict(m_scores, [&](Index plane, Index cell, std::span<const float> predicted) {
        const auto n = std::ssize(predicted);
        const float *lambda = m_lambda.data() + cell;
        float *to = m_next.data() + plane * cells + cell;
        float *best = statistic.data() + cell;
        if (m_rule.law == ResetLaw::None) {
            joinNothing(predicted.data(), lambda, lnK, n, to, best);
            all.count += n;
            return;
        }
        all.count += joinReset(predicted.data(), lambda, lnK, n, to, best);
        if (m_rule.law == ResetLaw::Mean)
            all.sum += sumContinued(predicted.data(), lnK, n);
        const Continued apart = inhibitedPart(cell, predicted);
        all.count -= apart.count;
        all.sum -= apart.sum;
    });
    std::swap(m_scores, m_next);
    const Index counted = m_rule.law == ResetLaw::None ? cells : cells - std::ssize(m_inhibited);
    if (counted > 0) {
        const auto states = static_cast<double>(counted * m_space.planeCount());
        m_regulation = {m_lnK, static_cast<double>(all.count) / states, m_lnK};
        regulate(m_regulation.continuedFraction, all.sum / states);
    }
    if (m_offset != 0.0)
        for (float &value : statistic)
            value += static_cast<float>(m_offset);
}

Smd::Continued Smd::inhibitedPart(Index firstCell, std::span<const float> predicted) const
{
    Continued part;
    if (m_rule.law == ResetLaw::None)
        return part;
    const auto lnK = static_cast<float>(m_lnK);
    for (auto cell = std::lower_bound(m_inhibited.begin(), m_inhibited.end(), firstCell);
         cell != m_inhibited.end() && *cell < firstCell + std::ssize(predicted); ++cell)
        if (const float going = predicted[static_cast<std::size_t>(*cell - firstCell)] + lnK; going > 0.0f) {
            ++part.count;
            part.sum += static_cast<double>(going);
        }
    return part;
}

void Smd::regulate(double continuedFraction, double meanContinued)
{
    switch (m_rule.law) {
    case ResetLaw::Fixed:
    case ResetLaw::None:
        break;
    case ResetLaw::Mean:
        m_offset = m_rule.k0 - meanContinued;
        m_lnK = m_offset;
        m_regulation.lnK = m_offset;
        break;
    case ResetLaw::Half:
        m_lnK += m_rule.gain * (0.5 - continuedFraction);
        break;
    }
}

void Smd::forget(const Grid &grid, const CellBox &box)
{
    const Index cells = m_space.cellCount();
    const auto background = static_cast<float>(-m_offset);
    box.forEachCell(grid, [&](Index cell) {
        for (Index plane = 0; plane < m_space.planeCount(); ++plane) {
            float &score = m_scores[static_cast<std::size_t>(plane * cells + cell)];
            score = std::min(score, std::max(background, 0.0f));
        }
    });
}

void Smd::restore(const Memory &memory)
{
    m_scores = memory.scores;
    m_lnK = memory.lnK;
    m_offset = memory.offset;
    m_isFirst = memory.isFirst;
}

} // namespace faintline
