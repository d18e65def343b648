#include "detect/PathTrace.h"

#include "detect/Recursion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    /// The part of the state space that a path of a given length into one cell can have come through.
    class Corridor
    {
    public:
        Corridor(const MarkovModel &model, const Grid &grid, Index cell, Index length)
            : m_grid(grid), m_origin(grid.coordinates(cell))
        {
            std::vector<KinematicAxis> axes = model.space.axes();
            for (std::size_t i = 0; i < axes.size(); ++i) {
                const Index reach = length * axes[i].largestDisplacement();
                if (axes[i].cyclic && 2 * reach + 1 >= axes[i].cells) {
                    m_origin[i] = 0;
                    continue;
                }
                Index from = m_origin[i] - reach;
                Index to = m_origin[i] + reach;
                if (!axes[i].cyclic) {
                    from = std::max<Index>(0, from);
                    to = std::min(axes[i].cells - 1, to);
                }
                axes[i].cells = to - from + 1;
                axes[i].cyclic = false;
                m_origin[i] = from;
            }
            space = StateSpace(std::move(axes));
            m_cells.resize(static_cast<std::size_t>(space.cellCount()));
            for (Index local = 0; local < space.cellCount(); ++local) {
                std::vector<Index> c = space.coordinates(local).cells;
                for (std::size_t i = 0; i < c.size(); ++i)
                    c[i] += m_origin[i];
                m_cells[static_cast<std::size_t>(local)] = m_grid.cell(c);
            }
        }

        /// Global cell of every local one.
        const std::vector<Index> &cells() const { return m_cells; }

        /// Local cell of a global one, or -1 outside of the corridor.
        Index localCell(Index cell) const
        {
            Index local = 0;
            Index stride = 1;
            for (std::size_t axis = m_origin.size(); axis-- > 0;) {
                const Axis &a = m_grid.axes[axis];
                Index offset = cell % a.count - m_origin[axis];
                cell /= a.count;
                if (a.cyclic)
                    offset = (offset % a.count + a.count) % a.count;
                if (offset < 0 || offset >= space.axes()[axis].cells)
                    return -1;
                local += offset * stride;
                stride *= space.axes()[axis].cells;
            }
            return local;
        }

        Index toLocal(const StateSpace &whole, Index state) const
        {
            return whole.planeOf(state) * space.cellCount() + localCell(whole.cellOf(state));
        }

        Index toGlobal(const StateSpace &whole, Index local) const
        {
            return space.planeOf(local) * whole.cellCount() + m_cells[static_cast<std::size_t>(space.cellOf(local))];
        }

        StateSpace space;

    private:
        const Grid &m_grid;
        std::vector<Index> m_origin;
        std::vector<Index> m_cells;
    };

    constexpr double scoreTolerance = 1e-4;
    constexpr float unreached = -std::numeric_limits<float>::infinity();

    void forget(const CellBox &box, const Grid &grid, const Corridor &corridor, std::vector<float> &scores)
    {
        box.forEachCell(grid, [&](Index cell) {
            const Index local = corridor.localCell(cell);
            for (Index plane = 0; local >= 0 && plane < corridor.space.planeCount(); ++plane) {
                float &score = scores[static_cast<std::size_t>(plane * corridor.space.cellCount() + local)];
                score = std::min(score, 0.0f);
            }
        });
    }

    /// Scores of the corridor's states for every frame from `first` on; all paths start inside the corridor.
    std::vector<std::vector<float>> runCorridor(const MarkovModel &model, const Grid &grid, const RecursionRecord &record,
                                                const Corridor &corridor, Index first, Index last)
    {
        const Index cells = corridor.space.cellCount();
        Recursion<MaxPlus<float>> recursion(corridor.space, model.transitionScale);
        std::vector<std::vector<float>> history;
        std::vector<float> y(static_cast<std::size_t>(cells));
        std::vector<float> lambda(y.size());
        for (Index frame = first; frame <= last; ++frame) {
            const std::span<const float> whole = record.frame(frame);
            for (std::size_t i = 0; i < y.size(); ++i)
                y[i] = whole[static_cast<std::size_t>(corridor.cells()[i])];
            model.likelihood.apply(y, lambda);
            std::vector<float> scores(static_cast<std::size_t>(corridor.space.stateCount()));
            const auto lnK = static_cast<float>(record.lnK(frame));
            std::span<const float> predicted;
            if (frame > first)
                predicted = recursion.predict(history.back());
            for (std::size_t n = 0, cell = 0; n < scores.size(); ++n, ++cell) {
                if (cell == y.size())
                    cell = 0;
                const float going = frame > first ? predicted[n] + lnK : unreached;
                scores[n] = lambda[cell] + (going > 0.0f ? going : 0.0f);
            }
            if (frame < last)
                for (const CellBox &box : record.forgotten(frame))
                    forget(box, grid, corridor, scores);
            history.push_back(std::move(scores));
        }
        return history;
    }

    /// Where a step's maximum came from, or -1 if the path was reset there.
    Index origin(const MarkovModel &model, const Corridor &corridor, const std::vector<float> &before, Index state, double lnK,
                 double &lnTransition)
    {
        Index best = -1;
        float bestScore = unreached;
        for (const StateSpace::Predecessor &p : corridor.space.predecessors(state)) {
            const double ln = p.lnProbability * model.transitionScale;
            const float score = before[static_cast<std::size_t>(p.state)] + static_cast<float>(ln);
            if (score > bestScore) {
                bestScore = score;
                best = p.state;
                lnTransition = ln;
            }
        }
        return bestScore + static_cast<float>(lnK) > 0.0f ? best : -1;
    }

} // namespace

std::vector<PathStep> tracePath(const MarkovModel &model, const Grid &grid, const RecursionRecord &record, Index frame,
                                Index state, double detectorScore)
{
    const Index known = frame - record.firstFrame + 1;
    for (Index length = 16;; length *= 2) {
        const Index used = std::min(length, known);
        const Index first = frame - used + 1;
        const Corridor corridor(model, grid, model.space.cellOf(state), used - 1);
        const auto history = runCorridor(model, grid, record, corridor, first, frame);

        Index local = corridor.toLocal(model.space, state);
        // Paths that start outside of the corridor are missing in it: what it finds is at most the detector's score.
        if (used < known && static_cast<double>(history.back()[static_cast<std::size_t>(local)]) < detectorScore - scoreTolerance)
            continue;
        std::vector<PathStep> path;
        for (Index t = frame;; --t) {
            PathStep step;
            step.frame = t;
            step.state = corridor.toGlobal(model.space, local);
            const Index cell = model.space.cellOf(step.state);
            step.logLikelihoodRatio = model.likelihood.at(static_cast<double>(record.frame(t)[static_cast<std::size_t>(cell)]));
            const Index before = t == first ? -1
                                            : origin(model, corridor, history[static_cast<std::size_t>(t - 1 - first)], local,
                                                     record.lnK(t), step.lnTransition);
            if (before < 0)
                step.lnTransition = 0.0;
            else
                step.lnK = record.lnK(t);
            path.push_back(step);
            if (before < 0)
                break;
            local = before;
        }
        std::reverse(path.begin(), path.end());
        double score = 0.0;
        for (PathStep &step : path) {
            score += step.logLikelihoodRatio + step.lnTransition + step.lnK;
            step.score = score;
        }
        return path;
    }
}

} // namespace faintline
