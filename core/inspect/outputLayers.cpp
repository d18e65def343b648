#include "inspect/outputLayers.h"

#include "base/logmath.h"
#include "inspect/StateReplay.h"

#include <algorithm>

namespace faintline {

namespace {

    constexpr std::int32_t notKnown = 1 << 30; ///< an unknown age; frames since then are added
    /// Sufficient age for paths of noise, most of which are reset after a few frames.
    constexpr Index ageOfSome = 512;

} // namespace

LayerReplay::LayerReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget)
    : m_analysis(std::move(analysis)), m_replay(*m_analysis, byteBudget / 2),
      m_checkpoints(m_replay.interval(), byteBudget / 2)
{
    for (std::size_t model = 0; model < m_analysis->modelCount(); ++model) {
        m_models.push_back(m_analysis->modelAt(model));
        m_ages.states.emplace_back(std::size_t(m_models.back().space.stateCount()));
    }
    m_before.resize(m_models.size());
    const auto cells = std::size_t(m_models.front().space.cellCount());
    m_layers.statistic.resize(cells);
    m_layers.model.resize(cells);
    m_layers.plane.resize(cells);
    m_layers.age.resize(cells);
    m_layers.resetFraction.resize(cells);
    m_layers.isInhibited.resize(cells);
}

const CellLayers &LayerReplay::at(Index frame, const RunContext &context, const Cells &aged)
{
    frame = std::clamp<Index>(frame, 0, m_analysis->time().count - 1);
    const Index lookback = aged.end - aged.begin > 1 ? ageOfSome : 0;
    const bool isOnItsWay = m_now >= 0 && m_now < frame && frame - m_now < lookback;
    if (frame != m_now)
        walk(isOnItsWay ? m_replay.next() : std::max<Index>(0, frame - lookback), frame, context);
    while (!knowsAges(aged))
        walk(std::max<Index>(0, frame - 2 * (frame + 1 - m_ages.since)), frame, context);
    return m_layers;
}

bool LayerReplay::knowsAges(const Cells &cells) const
{
    const auto begin = m_layers.age.begin() + std::min(cells.begin, std::ssize(m_layers.age));
    const auto end = m_layers.age.begin() + std::min(cells.end, std::ssize(m_layers.age));
    return m_ages.since == 0 || std::all_of(begin, end, [](std::int32_t age) { return age < notKnown; });
}

void LayerReplay::walk(Index begin, Index frame, const RunContext &context)
{
    seek(begin);
    const Index first = m_replay.next();
    while (m_replay.next() <= frame) {
        context.checkpoint(double(m_replay.next() - first) / double(frame + 1 - first), "following all paths");
        step();
    }
}

void LayerReplay::seek(Index frame)
{
    m_replay.seek(frame);
    if (m_replay.next() == m_now + 1)
        return;
    m_now = m_replay.next() - 1;
    if (const auto known = m_checkpoints.at(m_replay.next()))
        m_ages = *known;
    else
        forgetAges();
}

void LayerReplay::forgetAges()
{
    m_ages.since = m_replay.next();
    for (std::vector<std::int32_t> &states : m_ages.states)
        std::fill(states.begin(), states.end(), notKnown);
    m_ages.trackers.clear();
    for (const HmmTracker &tracker : m_replay.chain().trackers())
        for (const HmmTracker::Origin &origin : tracker.origins())
            m_ages.trackers[tracker.track().id][origin.state] = notKnown;
}

/// A model's scores before the next frame's step, after forgetting.
std::vector<float> LayerReplay::scoresBefore(std::size_t model) const
{
    const PathDetector &detector = m_replay.chain().detector();
    std::vector<float> scores(detector.scores(model).begin(), detector.scores(model).end());
    const auto background = std::max(0.0f, float(-detector.offset(model)));
    const Index cells = m_analysis->grid().size();
    for (const CellBox &box : m_replay.chain().forgotten())
        box.forEachCell(m_analysis->grid(), [&](Index cell) {
            for (auto state = std::size_t(cell); state < scores.size(); state += std::size_t(cells))
                scores[state] = std::min(scores[state], background);
        });
    return scores;
}

void LayerReplay::step()
{
    const Index frame = m_replay.next();
    const bool isFirst = frame == 0;
    for (std::size_t model = 0; model < m_models.size() && !isFirst; ++model)
        m_before[model] = scoresBefore(model);
    const std::span<const float> statistic = m_replay.step();
    for (std::size_t model = 0; model < m_models.size(); ++model)
        if (isFirst)
            std::fill(m_ages.states[model].begin(), m_ages.states[model].end(), 0);
        else
            followPaths(model, frame);
    followTrackers();
    m_now = m_layers.frame = frame;
    project(statistic);
    if (m_replay.beginning() != m_beginning) {
        m_checkpoints.clear(); // as in the replay
        m_beginning = m_replay.beginning();
    }
    const Index next = m_replay.next();
    if (next % m_checkpoints.interval() != 0 || next == m_beginning)
        return;
    if (const auto known = m_checkpoints.at(next); !known || known->since > m_ages.since)
        m_checkpoints.keep(next, std::make_shared<const Ages>(m_ages), m_ages.bytes());
}

std::size_t LayerReplay::Ages::bytes() const
{
    constexpr std::size_t stateBytes =
        sizeof(TrackerAges::mapped_type::value_type) + 2 * sizeof(void *); // a node and its bucket
    std::size_t total = sizeof *this;
    for (const std::vector<std::int32_t> &ages : states)
        total += sizeof ages + ages.capacity() * sizeof(std::int32_t);
    for (const auto &[track, ages] : trackers)
        total += sizeof ages + 4 * sizeof(void *) + ages.size() * stateBytes;
    return total;
}

void LayerReplay::followPaths(std::size_t model, Index frame)
{
    std::swap(m_paths.scores, m_before[model]);
    std::swap(m_paths.carried, m_ages.states[model]);
    carryAlong(m_models[model], frame, m_paths, m_moved);
    const auto lnK = float(m_replay.chain().detector().regulation(model).stepLnK);
    for (std::size_t state = 0; state < m_paths.carried.size(); ++state)
        m_paths.carried[state] = m_paths.scores[state] + lnK > 0.0f ? m_paths.carried[state] + 1 : 0;
    std::swap(m_paths.carried, m_ages.states[model]);
}

/// Age of the oldest path through a state's cell: when a track changes its model, its states are others.
std::int32_t LayerReplay::oldestAt(Index state, const std::unordered_map<Index, std::int32_t> &ages) const
{
    const StateSpace &space = m_models.front().space; // all models have the same cells
    std::int32_t oldest = 0;
    for (const auto &[other, age] : ages)
        if (space.cellOf(other) == space.cellOf(state))
            oldest = std::max(oldest, age);
    return oldest;
}

void LayerReplay::followTrackers()
{
    TrackerAges now;
    for (const HmmTracker &tracker : m_replay.chain().trackers()) {
        const auto earlier = m_ages.trackers.find(tracker.track().id);
        const bool isNew = tracker.age() == 1 || earlier == m_ages.trackers.end();
        auto &ages = now[tracker.track().id];
        for (const auto &[state, before] : tracker.origins()) {
            if (isNew) {
                ages[state] = m_ages.states[tracker.track().model][std::size_t(state)];
                continue;
            }
            const auto from = earlier->second.find(before);
            ages[state] = 1 + (from == earlier->second.end() ? oldestAt(before, earlier->second) : from->second);
        }
    }
    m_ages.trackers = std::move(now);
}

void LayerReplay::project(std::span<const float> statistic)
{
    const DetectionChain &chain = m_replay.chain();
    const auto cells = std::size_t(m_analysis->grid().size());
    std::copy(statistic.begin(), statistic.end(), m_layers.statistic.begin());
    std::fill(m_layers.isInhibited.begin(), m_layers.isInhibited.end(), '\0');
    for (std::size_t cell = 0; cell < cells; ++cell)
        m_layers.model[cell] = static_cast<unsigned char>(chain.detector().winnerAt(Index(cell)));
    std::fill(m_layers.resetFraction.begin(), m_layers.resetFraction.end(), 0.0f);
    std::vector<float> best(cells, unreached);
    for (std::size_t model = 0; model < m_models.size(); ++model) {
        const std::span<const float> scores = chain.detector().scores(model);
        for (std::size_t plane = 0, state = 0; state < scores.size(); ++plane)
            for (std::size_t cell = 0; cell < cells; ++cell, ++state) {
                if (m_layers.model[cell] != model)
                    continue;
                const std::int32_t age = m_ages.states[model][state];
                m_layers.resetFraction[cell] += age == 0 ? 1.0f : 0.0f; // counts resets, for now
                if (plane == 0 || scores[state] > best[cell]) {
                    best[cell] = scores[state];
                    m_layers.plane[cell] = std::int32_t(plane);
                    m_layers.age[cell] = age;
                }
            }
    }
    for (std::size_t cell = 0; cell < cells; ++cell)
        m_layers.resetFraction[cell] /= float(m_models[m_layers.model[cell]].space.planeCount());
    std::unordered_map<std::size_t, double> followed; ///< statistic of cells that a tracker covers
    for (const HmmTracker &tracker : chain.trackers())
        for (const auto &[state, age] : m_ages.trackers[tracker.track().id]) {
            const auto cell = std::size_t(state) % cells;
            const auto [shown, isFirst] = followed.try_emplace(cell);
            if (isFirst)
                shown->second = double(shownScore(*m_analysis, chain, m_layers.model[cell], best[cell]));
            Index candidate = 0;
            if (const double score = tracker.scoreAt(Index(cell), &candidate);
                candidate == state && score > shown->second) {
                shown->second = score;
                m_layers.model[cell] = static_cast<unsigned char>(tracker.model());
                m_layers.plane[cell] = std::int32_t(std::size_t(state) / cells);
                m_layers.age[cell] = age;
                m_layers.resetFraction[cell] = 0.0f; // a tracker's paths are not reset
            }
        }
    for (const auto &[track, box] : chain.inhibitions())
        if (track == 0 || m_analysis->settings.decide.inhibits) // 0: where no signal is looked for
            box.forEachCell(m_analysis->grid(), [&](Index cell) { m_layers.isInhibited[std::size_t(cell)] = 1; });
}

} // namespace faintline
