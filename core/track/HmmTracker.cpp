#include "track/HmmTracker.h"

#include "base/logmath.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

HmmTracker::HmmTracker(TrackerModel &model, Track start, const Seed &seed)
    : m_model(&model), m_track(std::move(start)), m_best(seed.state)
{
    Slice slice;
    slice.frame = m_track.detectFrame;
    slice.centre = model.grid.coordinates(model.space.cellOf(seed.state));
    slice.scores.assign(std::size_t(model.window.stateCount()), unreached);
    m_statistic = double(seed.scores[std::size_t(seed.state)]) + seed.offset;
    slice.offset = m_statistic;
    for (Index local = 0; local < model.window.stateCount(); ++local) {
        const Index cell = model.windowCell(slice.centre, model.window.cellOf(local));
        if (std::binary_search(seed.cells.begin(), seed.cells.end(), cell)) {
            const Index global = model.window.planeOf(local) * model.space.cellCount() + cell;
            slice.scores[std::size_t(local)] =
                float(double(seed.scores[std::size_t(global)]) + seed.offset - slice.offset);
        }
    }
    m_history.push_back(std::move(slice));
    m_level = std::clamp(m_statistic, model.threshold, model.threshold + model.settings.ceilingNats);
    holdLevel();
    m_track.peakStatistic = m_statistic;
    if (!m_track.points.empty())
        m_track.points.pop_back(); // the detection frame's point is traced again
}

HmmTracker HmmTracker::withoutPast(TrackerModel &model) const
{
    HmmTracker result;
    result.m_model = &model;
    result.m_track = m_track.withoutPoints();
    result.m_history.push_back(m_history.back());
    result.m_age = m_age;
    result.m_fallFrame = m_fallFrame;
    result.m_fallLevel = m_fallLevel;
    result.m_best = m_best;
    result.m_beside = m_beside;
    result.m_statistic = m_statistic;
    result.m_level = m_level;
    return result;
}

std::size_t HmmTracker::bytes() const
{
    constexpr std::size_t dequeBytes = 512 + 8 * sizeof(void *); // one node and the map of nodes
    std::size_t total = sizeof *this + dequeBytes + m_track.points.capacity() * sizeof(TrackPoint)
                        + m_beside.capacity() * sizeof(Beside);
    for (const Slice &slice : m_history)
        total += sizeof slice + slice.centre.capacity() * sizeof(Index)
                 + (slice.scores.capacity() + slice.lambda.capacity()) * sizeof(float);
    return m_former ? total + m_former->bytes() : total;
}

/// Updates the beginning of the final fall: the change point between "holds" and "loses half the decay per frame".
void HmmTracker::holdLevel()
{
    const double tilt = 0.5 * m_model->settings.decayNats;
    const double tilted = m_level + tilt * double(m_age);
    if (m_age == 0 || tilted >= m_fallLevel) {
        m_fallLevel = tilted;
        m_fallFrame = m_age;
    }
    ++m_age;
}

bool HmmTracker::update(Index frame, std::span<const float> lambda, double lnK)
{
    TrackerModel &model = *m_model;
    const Slice &last = m_history.back();
    // Copies old scores into the middle of the padded window.
    std::fill(model.scores.begin(), model.scores.end(), unreached);
    const Index windowCells = model.window.cellCount();
    const Index cells = model.padded.cellCount();
    const std::vector<Index> unmoved(model.halfWidth.size(), 0);
    for (Index cell = 0; cell < windowCells; ++cell) {
        const Index target = model.inPadded(cell, unmoved);
        for (Index plane = 0; plane < model.window.planeCount(); ++plane)
            model.scores[std::size_t(plane * cells + target)] = last.scores[std::size_t(plane * windowCells + cell)];
    }
    const std::span<float> predicted = model.recursion.predict(model.scores, frame);
    for (Index cell = 0; cell < cells; ++cell) {
        const Index global = model.paddedCell(last.centre, cell);
        const float gain = global < 0 ? unreached : lambda[std::size_t(global)] + float(lnK);
        for (Index plane = 0; plane < model.padded.planeCount(); ++plane) {
            const auto n = std::size_t(plane * cells + cell);
            model.scores[n] = gain == unreached ? unreached : predicted[n] + gain;
        }
    }
    follow(frame, lambda, lnK);
    const double ceiling = model.threshold + model.settings.ceilingNats;
    if (m_level >= model.threshold + model.settings.confirmNats
        && frame - m_track.detectFrame + 1 >= model.settings.confirmFrames && !m_track.isConfirmed) {
        m_track.isConfirmed = true;
        m_track.confirmFrame = frame;
    }
    m_level = std::min(m_level, ceiling);
    holdLevel();
    const auto lag = std::size_t(model.settings.smoothingFrames);
    if (m_history.size() >= 2 * lag + 1)
        commit(lag);
    return m_level >= model.threshold - model.settings.endNats;
}

void HmmTracker::follow(Index frame, std::span<const float> lambda, double lnK)
{
    TrackerModel &model = *m_model;
    const auto best = std::max_element(model.scores.begin(), model.scores.end());
    const Index local = best - model.scores.begin();
    const double before = m_statistic;
    const Slice &last = m_history.back();
    if (*best == unreached) { // has left the grid
        m_level = minusInfinity;
        return;
    }
    m_statistic = last.offset + double(*best);
    m_level += m_statistic - before - model.settings.decayNats;
    m_track.peakStatistic = std::max(m_track.peakStatistic, m_statistic);

    std::vector<Index> centre = model.padded.coordinates(local).cells;
    for (std::size_t axis = 0; axis < centre.size(); ++axis)
        centre[axis] =
            model.grid.axes[axis].wrapped(centre[axis] + last.centre[axis] - model.halfWidth[axis] - model.reach[axis]);
    m_best = model.padded.planeOf(local) * model.space.cellCount() + model.grid.cell(centre);
    m_history.push_back(cutOut(frame, centre, lambda, lnK));
}

HmmTracker::Slice HmmTracker::cutOut(Index frame, const std::vector<Index> &centre, std::span<const float> lambda,
                                     double lnK) const
{
    const TrackerModel &model = *m_model;
    const Slice &last = m_history.back();
    Slice slice{frame,       centre, std::vector<float>(std::size_t(model.window.stateCount()), unreached),
                m_statistic, {},     lnK};
    for (Index cell = 0; cell < model.window.cellCount(); ++cell) {
        const Index global = model.windowCell(centre, cell);
        slice.lambda.push_back(global < 0 ? 0.0f : lambda[std::size_t(global)]);
    }
    const double shift = last.offset - m_statistic;
    std::vector<Index> moved;
    for (std::size_t axis = 0; axis < centre.size(); ++axis)
        moved.push_back(model.grid.axes[axis].steps(last.centre[axis], centre[axis]));
    const Index cells = model.window.cellCount();
    for (Index cell = 0; cell < cells; ++cell) {
        const Index source = model.inPadded(cell, moved);
        for (Index plane = 0; source >= 0 && plane < model.window.planeCount(); ++plane)
            slice.scores[std::size_t(plane * cells + cell)] =
                float(double(model.scores[std::size_t(plane * model.padded.cellCount() + source)]) + shift);
    }
    return slice;
}

Index HmmTracker::localOf(const Slice &slice, Index state) const
{
    const TrackerModel &model = *m_model;
    StateSpace::Coordinates c = model.space.coordinates(state);
    for (std::size_t axis = 0; axis < c.cells.size(); ++axis) {
        c.cells[axis] = model.grid.axes[axis].steps(slice.centre[axis], c.cells[axis]) + model.halfWidth[axis];
        if (c.cells[axis] < 0 || c.cells[axis] >= model.window.axes()[axis].cells)
            return -1;
    }
    return model.window.state(c);
}

Index HmmTracker::predecessorIn(const Slice &earlier, Index state, PathStep &step) const
{
    const TrackerModel &model = *m_model;
    float best = unreached;
    float second = unreached;
    Index origin = state;
    for (const StateSpace::Predecessor &p : model.space.predecessors(state, earlier.frame + 1)) {
        const Index from = localOf(earlier, p.state);
        if (from < 0)
            continue;
        const double ln = p.lnProbability * model.transitionScale;
        const float score = earlier.scores[std::size_t(from)] + float(ln);
        if (score > best) {
            second = best;
            best = score;
            origin = p.state;
            step.lnTransition = ln;
        } else {
            second = std::max(second, score);
        }
    }
    if (second > unreached)
        step.runnerUp = double(best - second);
    return origin;
}

double HmmTracker::scoreAt(Index cell, Index *state) const
{
    const Slice &slice = m_history.back();
    double best = minusInfinity;
    for (Index plane = 0; plane < m_model->space.planeCount(); ++plane) {
        const Index candidate = plane * m_model->space.cellCount() + cell;
        const Index local = localOf(slice, candidate);
        if (local < 0)
            break;
        const double score = slice.offset + double(slice.scores[std::size_t(local)]);
        if (score > best) {
            best = score;
            if (state)
                *state = candidate;
        }
    }
    return best;
}

std::vector<HmmTracker::Origin> HmmTracker::origins() const
{
    const TrackerModel &model = *m_model;
    const Slice &newest = m_history.back();
    std::vector<Origin> result;
    for (Index local = 0; local < model.window.stateCount(); ++local) {
        const Index cell = model.windowCell(newest.centre, model.window.cellOf(local));
        if (cell < 0 || newest.scores[std::size_t(local)] == unreached)
            continue;
        const Index state = model.window.planeOf(local) * model.space.cellCount() + cell;
        PathStep step;
        result.push_back(
            {state, m_history.size() < 2 ? state : predecessorIn(m_history[m_history.size() - 2], state, step)});
    }
    return result;
}

std::vector<PathStep> HmmTracker::explain(Index state) const
{
    std::vector<PathStep> path;
    for (std::size_t i = m_history.size(); i-- > 0;) {
        const Slice &slice = m_history[i];
        const Index local = localOf(slice, state);
        PathStep step;
        step.frame = slice.frame;
        step.state = state;
        step.score = slice.offset + double(slice.scores[std::size_t(local)]);
        if (i > 0) {
            step.logLikelihoodRatio = double(slice.lambda[std::size_t(m_model->window.cellOf(local))]);
            step.lnK = slice.lnK;
            state = predecessorIn(m_history[i - 1], state, step);
        }
        path.push_back(step);
    }
    std::reverse(path.begin(), path.end());
    if (!m_former)
        return path;
    std::vector<PathStep> before = m_former->explain(m_former->stateBefore(path.front().state, m_model->space));
    before.back().state = path.front().state;
    before.back().lnTransition += m_lnChange;
    before.back().score = path.front().score;
    before.insert(before.end(), path.begin() + 1, path.end());
    return before;
}

std::vector<TrackPoint> HmmTracker::pathTo(Index state) const
{
    const TrackerModel &model = *m_model;
    std::vector<TrackPoint> path(m_history.size());
    for (std::size_t i = m_history.size(); i-- > 0;) {
        const Slice &slice = m_history[i];
        const Index local = localOf(slice, state);
        path[i] = {slice.frame, model.space.cellOf(state), model.space.planeOf(state),
                   slice.offset + double(slice.scores[std::size_t(local)])};
        if (i == 0)
            break;
        PathStep step;
        state = predecessorIn(m_history[i - 1], state, step);
    }
    return path;
}

void HmmTracker::measureFirst(std::size_t count, std::vector<TrackPoint> &path) const
{
    if (!m_model->measuresOffsets)
        return;
    measureOffsets(path, count, [this](std::size_t i, Index cell) {
        const Slice &slice = m_history[i];
        const Index at = cell - slice.centre.front() + m_model->halfWidth.front();
        return at < 0 || at >= std::ssize(slice.lambda) ? 0.0f : slice.lambda[std::size_t(at)];
    });
}

double HmmTracker::displacement() const
{
    std::vector<TrackPoint> path = pathTo(m_best);
    measureFirst(path.size(), path);
    return double(path.back().offset);
}

void HmmTracker::commit(std::size_t count)
{
    std::vector<TrackPoint> path = pathTo(m_best);
    measureFirst(count, path);
    m_track.points.insert(m_track.points.end(), path.begin(), path.begin() + std::ptrdiff_t(count));
    m_history.erase(m_history.begin(), m_history.begin() + std::ptrdiff_t(count));
    m_former.reset(); // the history no longer reaches it
}

void HmmTracker::paint(std::span<float> statistic) const
{
    const TrackerModel &model = *m_model;
    const Slice &slice = m_history.back();
    for (Index cell = 0; cell < model.window.cellCount(); ++cell) {
        const Index global = model.windowCell(slice.centre, cell);
        if (global < 0)
            continue;
        float best = unreached;
        for (Index plane = 0; plane < model.window.planeCount(); ++plane)
            best = std::max(best, slice.scores[std::size_t(plane * model.window.cellCount() + cell)]);
        float &value = statistic[std::size_t(global)];
        value = std::max(value, best + float(slice.offset));
    }
}

void HmmTracker::paintStates(std::span<float> scores) const
{
    const TrackerModel &model = *m_model;
    const Slice &slice = m_history.back();
    for (Index cell = 0; cell < model.window.cellCount(); ++cell) {
        const Index global = model.windowCell(slice.centre, cell);
        if (global < 0)
            continue;
        for (Index plane = 0; plane < model.window.planeCount(); ++plane) {
            float &value = scores[std::size_t(plane * model.space.cellCount() + global)];
            value = std::max(value,
                             slice.scores[std::size_t(plane * model.window.cellCount() + cell)] + float(slice.offset));
        }
    }
}

Track HmmTracker::finish(bool isOpen)
{
    commit(m_history.size());
    m_track.isOpen = isOpen && m_level >= m_model->threshold;
    m_track.endFrame = m_track.isOpen ? m_track.points.back().frame : m_track.detectFrame + m_fallFrame;
    while (m_track.points.size() > 1 && m_track.points.back().frame > m_track.endFrame)
        m_track.points.pop_back();
    m_track.endFrame = m_track.points.back().frame;
    return std::move(m_track);
}

} // namespace faintline
