#include "analysis/outputLayers.h"

#include "base/Error.h"
#include "detect/Smd.h"

#include <algorithm>
#include <limits>

namespace faintline {

namespace {

    constexpr float unreached = -std::numeric_limits<float>::infinity();

    double rateUnit(const Analysis &analysis)
    {
        return analysis.grid().axes.front().step / analysis.time().step;
    }

    std::vector<float> ratesOfPlanes(const Analysis &analysis)
    {
        std::vector<float> rates;
        for (Index plane = 0; plane < analysis.model.space.planeCount(); ++plane)
            rates.push_back(static_cast<float>(analysis.model.space.ratesOfPlane(plane).front() * rateUnit(analysis)));
        return rates;
    }

} // namespace

LayerReplay::LayerReplay(std::shared_ptr<const Analysis> analysis, std::size_t byteBudget) : m_replay(std::move(analysis), byteBudget / 2)
{
    const StateSpace &space = this->analysis()->model.space;
    if (space.axes().size() != 1 || !this->analysis()->bank.empty())
        throw Error("output layers", "are of lines over frequency; these frames have more than one axis");
    const auto cells = static_cast<std::size_t>(space.cellCount());
    m_ages.states.resize(static_cast<std::size_t>(space.stateCount()));
    m_agesBefore.resize(m_ages.states.size());
    m_layers.statistic.resize(cells);
    m_layers.plane.resize(cells);
    m_layers.age.resize(cells);
    m_layers.resetFraction.resize(cells);
    m_layers.isInhibited.resize(cells);
}

const CellLayers &LayerReplay::at(Index frame, const RunContext &context)
{
    frame = std::clamp<Index>(frame, 0, analysis()->time().count - 1);
    if (frame == m_now)
        return m_layers;
    seek(frame);
    const Index first = m_replay.next();
    while (m_replay.next() <= frame) {
        context.checkpoint(static_cast<double>(m_replay.next() - first) / static_cast<double>(frame + 1 - first), "following all paths");
        step();
    }
    return m_layers;
}

void LayerReplay::seek(Index frame)
{
    m_replay.seek(frame);
    if (m_replay.next() == m_now + 1)
        return;
    m_now = m_replay.next() - 1;
    if (m_replay.next() > 0)
        m_ages = *m_checkpoints.at(m_replay.next());
    else
        m_ages.trackers.clear();
}

/// The detector's scores as the next frame's step will find them, what it is about to forget forgotten.
std::vector<float> LayerReplay::scoresBefore() const
{
    const Detector &detector = m_replay.chain().detector();
    std::vector<float> scores(detector.scores().begin(), detector.scores().end());
    const auto *smd = dynamic_cast<const Smd *>(&detector);
    const auto background = std::max(0.0f, static_cast<float>(smd ? -smd->offset() : 0.0));
    const Index cells = analysis()->grid().size();
    for (const CellBox &box : m_replay.chain().forgotten())
        box.forEachCell(analysis()->grid(), [&](Index cell) {
            for (auto state = static_cast<std::size_t>(cell); state < scores.size(); state += static_cast<std::size_t>(cells))
                scores[state] = std::min(scores[state], background);
        });
    return scores;
}

void LayerReplay::step()
{
    const Index frame = m_replay.next();
    const bool isFirst = frame == 0;
    const std::vector<float> before = isFirst ? std::vector<float>() : scoresBefore();
    const std::span<const float> statistic = m_replay.step();
    if (isFirst)
        std::fill(m_ages.states.begin(), m_ages.states.end(), 0);
    else
        followPaths(before);
    followTrackers();
    m_now = m_layers.frame = frame;
    project(statistic);
    if (m_replay.next() % m_replay.interval() == 0 && !m_checkpoints.contains(m_replay.next()))
        m_checkpoints.emplace(m_replay.next(), std::make_shared<const Ages>(m_ages));
}

void LayerReplay::followPaths(std::span<const float> before)
{
    std::swap(m_ages.states, m_agesBefore);
    const MarkovModel &model = analysis()->model;
    const KinematicAxis &axis = model.space.axes().front();
    const auto cells = static_cast<std::size_t>(axis.cells);
    const auto lnK = static_cast<float>(m_replay.chain().detector().regulation().stepLnK);
    std::vector<float> best(cells);
    std::vector<std::int32_t> age(cells);
    const std::vector<KinematicAxis::Move> moves = axis.moves();
    for (int rate = 0; rate < axis.rateCount; ++rate) {
        std::fill(best.begin(), best.end(), unreached);
        for (const KinematicAxis::Move &move : moves) { // in the order that decides ties
            if (move.toRate != rate)
                continue;
            const auto ln = static_cast<float>(move.lnProbability * model.transitionScale);
            const std::size_t plane = static_cast<std::size_t>(move.fromRate) * cells;
            const auto take = [&](Index to, Index from, Index count) {
                for (Index i = 0; i < count; ++i) {
                    const auto target = static_cast<std::size_t>(to + i);
                    const std::size_t source = plane + static_cast<std::size_t>(from + i);
                    const float score = before[source] + ln;
                    age[target] = score > best[target] ? m_agesBefore[source] : age[target];
                    best[target] = score > best[target] ? score : best[target];
                }
            };
            const Index shift = move.cells;
            if (std::abs(shift) >= axis.cells)
                continue;
            take(std::max<Index>(shift, 0), std::max<Index>(-shift, 0), axis.cells - std::abs(shift));
            if (axis.cyclic && shift > 0)
                take(0, axis.cells - shift, shift);
            if (axis.cyclic && shift < 0)
                take(axis.cells + shift, 0, -shift);
        }
        std::int32_t *to = m_ages.states.data() + static_cast<std::size_t>(rate) * cells;
        for (std::size_t cell = 0; cell < cells; ++cell)
            to[cell] = best[cell] + lnK > 0.0f ? age[cell] + 1 : 0;
    }
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
                ages[state] = m_ages.states[static_cast<std::size_t>(state)];
                continue;
            }
            const auto from = earlier->second.find(before);
            ages[state] = 1 + (from == earlier->second.end() ? 0 : from->second);
        }
    }
    m_ages.trackers = std::move(now);
}

void LayerReplay::project(std::span<const float> statistic)
{
    const StateSpace &space = analysis()->model.space;
    const auto cells = static_cast<std::size_t>(space.cellCount());
    const std::span<const float> scores = m_replay.chain().detector().scores();
    std::copy(statistic.begin(), statistic.end(), m_layers.statistic.begin());
    std::vector<float> best(scores.begin(), scores.begin() + static_cast<std::ptrdiff_t>(cells));
    std::fill(m_layers.plane.begin(), m_layers.plane.end(), 0);
    std::fill(m_layers.isInhibited.begin(), m_layers.isInhibited.end(), '\0');
    for (std::size_t cell = 0; cell < cells; ++cell) {
        int resets = 0;
        for (Index plane = 0; plane < space.planeCount(); ++plane) {
            const std::size_t state = static_cast<std::size_t>(plane) * cells + cell;
            resets += m_ages.states[state] == 0 ? 1 : 0;
            if (scores[state] > best[cell]) {
                best[cell] = scores[state];
                m_layers.plane[cell] = static_cast<std::int32_t>(plane);
            }
        }
        m_layers.age[cell] = m_ages.states[static_cast<std::size_t>(m_layers.plane[cell]) * cells + cell];
        m_layers.resetFraction[cell] = static_cast<float>(resets) / static_cast<float>(space.planeCount());
    }
    for (const HmmTracker &tracker : m_replay.chain().trackers())
        for (const auto &[state, age] : m_ages.trackers[tracker.track().id]) {
            const auto cell = static_cast<std::size_t>(space.cellOf(state));
            Index candidate = 0;
            if (const double score = tracker.scoreAt(space.cellOf(state), &candidate);
                candidate == state && score > static_cast<double>(best[cell])) {
                best[cell] = static_cast<float>(score);
                m_layers.plane[cell] = static_cast<std::int32_t>(space.planeOf(state));
                m_layers.age[cell] = age;
                m_layers.resetFraction[cell] = 0.0f; // a tracker's paths are not reset
            }
        }
    for (const CellBox &box : m_replay.chain().inhibited())
        box.forEachCell(analysis()->grid(), [&](Index cell) { m_layers.isInhibited[static_cast<std::size_t>(cell)] = 1; });
}

const std::vector<float> &LayerPicture::values(OutputLayer layer) const
{
    switch (layer) {
    case OutputLayer::Rate:
        return rate;
    case OutputLayer::Age:
        return age;
    case OutputLayer::Reset:
        return resetFraction;
    case OutputLayer::Inhibited:
        return inhibited;
    case OutputLayer::Statistic:
        break;
    }
    return statistic;
}

LayerPicture layerPicture(LayerReplay &replay, const LayerWindow &window, const RunContext &context)
{
    const Analysis &analysis = *replay.analysis();
    const Index endFrame = std::min(window.endFrame, analysis.time().count);
    const Index endCell = std::min(window.endCell, analysis.grid().size());
    const Index beginFrame = std::clamp<Index>(window.beginFrame, 0, endFrame);
    const Index beginCell = std::clamp<Index>(window.beginCell, 0, endCell);
    LayerPicture picture;
    const auto per = [](Index length, Index most) { return std::max<Index>(1, (length + most - 1) / std::max<Index>(1, most)); };
    picture.framesPerRow = per(endFrame - beginFrame, window.mostRows);
    picture.cellsPerColumn = per(endCell - beginCell, window.mostColumns);
    picture.firstRow = beginFrame / picture.framesPerRow;
    picture.firstColumn = beginCell / picture.cellsPerColumn;
    picture.rows = endFrame > beginFrame ? (endFrame - 1) / picture.framesPerRow - picture.firstRow + 1 : 0;
    picture.columns = endCell > beginCell ? (endCell - 1) / picture.cellsPerColumn - picture.firstColumn + 1 : 0;
    const auto size = static_cast<std::size_t>(picture.rows * picture.columns);
    picture.statistic.assign(size, unreached);
    for (std::vector<float> *values : {&picture.rate, &picture.age, &picture.resetFraction, &picture.inhibited})
        values->assign(size, 0.0f);
    const std::vector<float> rates = ratesOfPlanes(analysis);
    const auto frameSeconds = static_cast<float>(analysis.time().step);
    for (Index row = 0; row < picture.rows; ++row) {
        const Index first = (picture.firstRow + row) * picture.framesPerRow;
        const Index last = std::min(first + picture.framesPerRow, analysis.time().count);
        for (Index frame = first; frame < last; ++frame) {
            const double done = static_cast<double>(row) / static_cast<double>(picture.rows);
            context.checkpoint(done, "layers");
            const CellLayers &layers = replay.at(frame, context.part(done, done));
            for (Index column = 0; column < picture.columns; ++column) {
                const Index from = (picture.firstColumn + column) * picture.cellsPerColumn;
                const auto pixel = static_cast<std::size_t>(row * picture.columns + column);
                for (Index i = from; i < std::min(from + picture.cellsPerColumn, analysis.grid().size()); ++i) {
                    const auto cell = static_cast<std::size_t>(i);
                    if (layers.isInhibited[cell])
                        picture.inhibited[pixel] = 1.0f;
                    if (!(layers.statistic[cell] > picture.statistic[pixel]))
                        continue;
                    picture.statistic[pixel] = layers.statistic[cell];
                    picture.rate[pixel] = rates[static_cast<std::size_t>(layers.plane[cell])];
                    picture.age[pixel] = static_cast<float>(layers.age[cell]) * frameSeconds;
                    picture.resetFraction[pixel] = layers.resetFraction[cell];
                }
            }
        }
    }
    return picture;
}

CellReading readCell(const Analysis &analysis, const CellLayers &layers, Index cell)
{
    const auto i = static_cast<std::size_t>(cell);
    return {analysis.model.space.ratesOfPlane(layers.plane[i]).front() * rateUnit(analysis),
            static_cast<double>(layers.age[i]) * analysis.time().step,
            layers.isInhibited[i] != 0, static_cast<double>(layers.statistic[i])};
}

} // namespace faintline
