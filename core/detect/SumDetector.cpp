#include "detect/SumDetector.h"

#include "base/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace faintline {

namespace {

    constexpr double representableSpanNats = 600.0; ///< nats; e^±700 is still representable

} // namespace

SumDetector::SumDetector(const MarkovModel &model, const ResetRule &rule)
    : m_space(model.space), m_likelihood(model.likelihood), m_rule(rule),
      m_recursion(model.space, model.transitionScale), m_weights(std::size_t(model.space.stateCount()), 1.0)
{
    if (rule.law != ResetLaw::Fixed && rule.law != ResetLaw::None)
        throw Error("reset.law", "must be fixed or none if the semiring is sum");
}

void SumDetector::update(std::span<const float> y, std::span<float> statistic)
{
    const auto cells = std::size_t(m_space.cellCount());
    std::vector<double> lambda(cells);
    for (std::size_t cell = 0; cell < cells; ++cell)
        lambda[cell] = m_likelihood.at(double(y[cell]));
    const auto [least, most] = std::minmax_element(lambda.begin(), lambda.end());
    const double highest = *most;
    const double background =
        m_rule.law == ResetLaw::Fixed ? std::abs(m_scale) : 0.0; // distance of a new path's 1 from the best
    const bool isWide = std::max(highest - *least, background) > representableSpanNats;
    m_scores.clear();
    if (isWide)
        updateWide(lambda);
    else
        updateWeights(lambda, highest);
    ++m_frames;
    m_lnMean = m_scale + std::log(std::accumulate(m_weights.begin(), m_weights.end(), 0.0) / double(m_weights.size()));

    for (std::size_t cell = 0; cell < cells; ++cell) {
        double largest = 0.0;
        float score = -std::numeric_limits<float>::infinity();
        for (std::size_t n = cell; n < m_weights.size(); n += cells) {
            largest = std::max(largest, m_weights[n]);
            if (isWide)
                score = std::max(score, m_scores[n]);
        }
        statistic[cell] = isWide ? score : scoreOf(largest);
    }
}

/// One step of the weights, the largest of which is then 1.
void SumDetector::updateWeights(std::span<const double> lambda, double highest)
{
    std::vector<double> ratio(lambda.size());
    for (std::size_t cell = 0; cell < ratio.size(); ++cell)
        ratio[cell] = std::exp(lambda[cell] - highest);
    std::span<const double> predicted;
    if (m_frames > 0)
        predicted = m_recursion.predict(m_weights, m_frames);
    const bool isFixed = m_rule.law == ResetLaw::Fixed;
    const double factor = isFixed ? std::exp(m_rule.lnK) : 1.0;
    const double fresh = isFixed ? std::exp(-m_scale) : 0.0;
    double largest = 0.0;
    for (std::size_t first = 0; first < m_weights.size(); first += ratio.size()) {
        for (std::size_t cell = 0; cell < ratio.size(); ++cell) {
            double &weight = m_weights[first + cell];
            if (!predicted.empty())
                weight = factor * predicted[first + cell] + fresh;
            weight *= ratio[cell];
            largest = std::max(largest, weight);
        }
    }
    m_scale += highest;
    if (largest > 0.0) {
        m_scale += std::log(largest);
        for (double &weight : m_weights)
            weight /= largest;
    }
}

float SumDetector::scoreOf(double weight) const
{
    return float(m_scale + std::log(weight));
}

std::span<const float> SumDetector::scores(std::size_t /*model*/) const
{
    if (m_scores.empty())
        for (double weight : m_weights)
            m_scores.push_back(scoreOf(weight));
    return m_scores;
}

/// The same step in logarithms, for the scores; weights and scale follow from them.
void SumDetector::updateWide(std::span<const double> lambda)
{
    std::vector<double> ln(m_weights.size(), 0.0);
    m_scores.resize(ln.size());
    const bool isFixed = m_rule.law == ResetLaw::Fixed;
    if (m_frames > 0) {
        const std::span<const double> predicted = m_recursion.predict(m_weights, m_frames);
        for (std::size_t n = 0; n < ln.size(); ++n) {
            const double goesOn = m_scale + (isFixed ? m_rule.lnK : 0.0) + std::log(predicted[n]);
            ln[n] = isFixed ? std::max(goesOn, 0.0) + std::log1p(std::exp(-std::abs(goesOn)))
                            : goesOn; // plus the new path's 1
        }
    }
    for (std::size_t n = 0; n < ln.size(); ++n)
        ln[n] += lambda[n % lambda.size()];
    m_scale = *std::max_element(ln.begin(), ln.end());
    for (std::size_t n = 0; n < ln.size(); ++n) {
        m_weights[n] = std::exp(ln[n] - m_scale);
        m_scores[n] = float(ln[n]);
    }
}

void SumDetector::forget(const Grid &grid, const CellBox &box)
{
    scores(); // those of the last frame remain
    const double background = std::exp(-m_scale);
    box.forEachCell(grid, [&](Index cell) {
        for (Index plane = 0; plane < m_space.planeCount(); ++plane) {
            double &weight = m_weights[std::size_t(plane * m_space.cellCount() + cell)];
            weight = std::min(weight, background);
        }
    });
}

/// Everything on which the next frame depends, and the last scores.
struct SumDetector::State final : DetectorState {
    std::vector<double> weights;
    std::vector<float> scores; ///< may be empty
    double scale = 0.0;
    double lnMean = 0.0;
    Index frames = 0;

    std::size_t bytes() const override
    {
        return sizeof *this + weights.capacity() * sizeof(double) + scores.capacity() * sizeof(float);
    }
};

std::shared_ptr<const DetectorState> SumDetector::state() const
{
    auto result = std::make_shared<State>();
    result->weights = m_weights;
    result->scores = m_scores;
    result->scale = m_scale;
    result->lnMean = m_lnMean;
    result->frames = m_frames;
    return result;
}

void SumDetector::setState(const DetectorState &state)
{
    const auto &saved = static_cast<const State &>(state);
    m_weights = saved.weights;
    m_scores = saved.scores;
    m_scale = saved.scale;
    m_lnMean = saved.lnMean;
    m_frames = saved.frames;
}

} // namespace faintline
