#include "detect/Smd.h"

#include "base/logmath.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// Number of values that are NaN: not observed.
    Index unknownIn(std::span<const float> y)
    {
        Index count = 0;
        for (const float value : y)
            count += value != value ? 1 : 0;
        return count;
    }

} // namespace

Smd::Smd(const MarkovModel &model, const ResetRule &rule)
    : m_space(model.space), m_likelihood(model.likelihood), m_rule(rule),
      m_recursion(model.space, model.transitionScale), m_scores(std::size_t(model.space.stateCount())),
      m_next(m_scores.size()), m_lnK(rule.law == ResetLaw::Fixed || rule.law == ResetLaw::Half ? rule.lnK : 0.0)
{
}

void Smd::update(std::span<const float> y, std::span<float> statistic)
{
    if (m_frames == 0) {
        start(y, statistic);
        return;
    }
    const Continued all = advance(y, statistic).front();
    const Index cells = m_space.cellCount();
    const std::vector<Index> apart = notCounted(y);
    if (const Index counted = cells - std::ssize(apart); counted > 0) {
        const Continued theirs = continuedAt(apart, y);
        const auto states = double(counted * m_space.planeCount());
        m_regulation = {m_lnK, double(all.count - theirs.count) / states, m_lnK};
        regulate(m_regulation.continuedFraction, (all.sum - theirs.sum) / states);
    }
    if (m_offset != 0.0)
        for (float &value : statistic)
            value += float(m_offset);
}

void Smd::start(std::span<const float> y, std::span<float> statistic)
{
    m_likelihood.apply(y, statistic);
    for (auto plane = m_scores.begin(); plane != m_scores.end(); plane += m_space.cellCount())
        std::copy(statistic.begin(), statistic.end(), plane);
    m_frames = 1;
    m_regulation = {m_lnK, 0.0, m_lnK};
    if (m_rule.law == ResetLaw::Mean) {
        // W(0) = 0 everywhere, so K(0) = K0.
        m_offset = m_rule.k0;
        m_lnK = m_offset;
        m_regulation.lnK = m_offset;
        for (float &value : statistic)
            value += float(m_offset);
    }
}

Index Smd::takenTogether(std::span<const float> y) const
{
    const Index cells = m_space.cellCount();
    const Index frames = std::min(m_recursion.framesAtOnce(), std::ssize(y) / cells);
    // A law that regulates K needs the frame before; states of unknown cells do not count.
    const bool isRegulated = m_rule.law == ResetLaw::Mean || m_rule.law == ResetLaw::Half;
    const bool isAlone = frames < 2 || m_frames == 0 || isRegulated;
    return isAlone || unknownIn(y.first(std::size_t(frames * cells))) > 0 ? 1 : frames;
}

std::vector<PathDetector::Regulation> Smd::updateTogether(std::span<const float> y, std::span<float> statistic,
                                                          std::span<const std::vector<Index>> inhibited)
{
    if (std::ssize(y) == m_space.cellCount())
        return PathDetector::updateTogether(y, statistic, inhibited);
    m_framesBefore = m_frames;
    m_regulationBefore = m_regulation;
    m_inhibited = inhibited.back();
    std::vector<Regulation> result;
    for (const Continued &continued : advance(y, statistic, inhibited)) {
        const bool isCounted = m_rule.law != ResetLaw::None;
        const Index apart = isCounted ? std::ssize(inhibited[result.size()]) : 0;
        if (const Index counted = (m_space.cellCount() - apart) * m_space.planeCount(); counted > 0)
            m_regulation = {m_lnK, double(continued.count) / double(counted), m_lnK};
        result.push_back(m_regulation);
    }
    return result;
}

void Smd::takeBack()
{
    std::swap(m_scores, m_next);
    m_frames = m_framesBefore;
    m_regulation = m_regulationBefore;
}

void Smd::updateBlock(std::span<const float> y, std::span<float> statistic, Index cells)
{
    while (!y.empty()) {
        // Cells that are inhibited until the next call are not forgotten.
        const Index count = m_inhibited.empty() ? takenTogether(y) : 1;
        const auto size = std::size_t(count * cells);
        if (count == 1)
            update(y.first(size), statistic.first(size));
        else
            updateTogether(y.first(size), statistic.first(size), std::vector<std::vector<Index>>(std::size_t(count)));
        y = y.subspan(size);
        statistic = statistic.subspan(size);
    }
}

std::vector<Continued> Smd::advance(std::span<const float> y, std::span<float> statistic,
                                    std::span<const std::vector<Index>> inhibited)
{
    FrameJoin join;
    join.lnK = float(m_lnK);
    join.floor = m_rule.law == ResetLaw::None ? unreached : 0.0f;
    join.counting = m_rule.law == ResetLaw::Mean ? Counting::StatesAndSum : Counting::States;
    std::vector<Continued> continued =
        m_recursion.advance(m_scores, m_next, {y, statistic, m_frames, inhibited}, m_likelihood, join);
    std::swap(m_scores, m_next);
    m_frames += std::ssize(y) / m_space.cellCount();
    if (m_rule.law == ResetLaw::None)
        for (Continued &each : continued)
            each.count = m_space.stateCount();
    return continued;
}

/// The cells that say nothing on K: inhibited, or without evidence, where all paths fade.
std::vector<Index> Smd::notCounted(std::span<const float> y) const
{
    if (m_rule.law == ResetLaw::None)
        return {};
    std::vector<Index> result = m_inhibited;
    const Index unknown = unknownIn(y);
    for (Index cell = 0; unknown > 0 && cell < std::ssize(y); ++cell)
        if (std::isnan(y[std::size_t(cell)]) && !std::ranges::binary_search(m_inhibited, cell))
            result.push_back(cell);
    return result;
}

/// Part of some cells: their scores minus the frame's own evidence.
Continued Smd::continuedAt(const std::vector<Index> &places, std::span<const float> y) const
{
    Continued part;
    const Index cells = m_space.cellCount();
    for (Index cell : places) {
        float lambda = 0.0f;
        m_likelihood.apply(y.subspan(std::size_t(cell), 1), {&lambda, 1});
        for (Index plane = 0; plane < m_space.planeCount(); ++plane)
            if (const float score = m_scores[std::size_t(plane * cells + cell)]; score > lambda) {
                ++part.count;
                part.sum += double(score - lambda);
            }
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
    const auto background = float(-m_offset);
    box.forEachCell(grid, [&](Index cell) {
        for (Index plane = 0; plane < m_space.planeCount(); ++plane) {
            float &score = m_scores[std::size_t(plane * cells + cell)];
            score = std::min(score, std::max(background, 0.0f));
        }
    });
}

/// Everything on which the next frame depends, and what a chain needs before it.
struct Smd::SmdState final : DetectorState {
    std::vector<float> scores;
    double lnK = 0.0;
    double offset = 0.0;
    Index frames = 0; ///< number taken
    Regulation regulation;
    std::vector<Index> inhibited;

    std::size_t bytes() const override
    {
        return sizeof *this + scores.capacity() * sizeof(float) + inhibited.capacity() * sizeof(Index);
    }
};

std::shared_ptr<const DetectorState> Smd::state() const
{
    auto result = std::make_shared<SmdState>();
    result->scores.assign(m_scores.begin(), m_scores.end());
    result->lnK = m_lnK;
    result->offset = m_offset;
    result->frames = m_frames;
    result->regulation = m_regulation;
    result->inhibited = m_inhibited;
    return result;
}

void Smd::setState(const DetectorState &state)
{
    const auto &saved = static_cast<const SmdState &>(state);
    m_scores.assign(saved.scores.begin(), saved.scores.end());
    m_lnK = saved.lnK;
    m_offset = saved.offset;
    m_frames = saved.frames;
    m_regulation = saved.regulation;
    m_inhibited = saved.inhibited;
}

} // namespace faintline
