#include "recursion/PathTrace.h"

#include "base/logmath.h"
#include "recursion/Recursion.h"

#include <algorithm>
#include <memory>
#include <span>

namespace faintline {

namespace {

    /// The part of the state space from which a path of a given length can reach a cell.
    class TracedCorridor
    {
    public:
        TracedCorridor(const MarkovModel &model, const Grid &grid, Index endState, Index length)
            : m_grid(grid), m_origin(grid.coordinates(model.space.cellOf(endState)))
        {
            const StateSpace::Coordinates end = model.space.coordinates(endState);
            std::vector<KinematicAxis> axes = model.space.axes();
            for (std::size_t i = 0; KinematicAxis & axis : axes) {
                restrictRates(axis, end.rates[i], length);
                restrictCells(axis, i++, length);
            }
            space = StateSpace(std::move(axes));
            m_cells.resize(std::size_t(space.cellCount()));
            for (Index local = 0; local < space.cellCount(); ++local) {
                std::vector<Index> c = space.coordinates(local).cells;
                for (std::size_t i = 0; i < c.size(); ++i)
                    c[i] += m_origin[i];
                m_cells[std::size_t(local)] = m_grid.cell(c);
            }
        }

        /// Global cell of each local one.
        const std::vector<Index> &cells() const { return m_cells; }

        /// Local cell of a global one, or -1 outside the corridor.
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
            StateSpace::Coordinates c = whole.coordinates(state);
            for (std::size_t i = 0; i < c.rates.size(); ++i)
                c.rates[i] -= m_lowestRate[i];
            c.cells.assign(c.cells.size(), 0);
            return space.state(c) + localCell(whole.cellOf(state));
        }

        Index toGlobal(const StateSpace &whole, Index local) const
        {
            StateSpace::Coordinates c = space.coordinates(local);
            const Index cell = m_cells[std::size_t(space.cellOf(local))];
            c.cells = m_grid.coordinates(cell);
            for (std::size_t i = 0; i < c.rates.size(); ++i)
                c.rates[i] += m_lowestRate[i];
            return whole.state(c);
        }

        StateSpace space;

    private:
        /// Limits the rates to those from which the end's rate can be reached in the number of steps.
        void restrictRates(KinematicAxis &axis, Index endRate, Index length)
        {
            Index reach = 0;
            for (std::size_t change = 0; change < axis.rateChange.size(); ++change)
                if (axis.rateChange[change] > 0.0)
                    reach = Index(change) * length;
            const Index lowest = std::max<Index>(0, endRate - reach);
            const Index highest = std::min<Index>(axis.rateCount - 1, endRate + reach);
            axis.firstRate += int(lowest);
            axis.rateCount = int(highest - lowest + 1);
            m_lowestRate.push_back(int(lowest));
        }

        /// Limits the cells to those from which these rates lead to the end in the number of steps.
        void restrictCells(KinematicAxis &axis, std::size_t i, Index length)
        {
            Index least = 0;
            Index most = 0;
            for (Index phase = 0; phase < axis.phaseCount(); ++phase)
                for (const KinematicAxis::Move &move : axis.moves(phase)) {
                    least = std::min<Index>(least, move.cells);
                    most = std::max<Index>(most, move.cells);
                }
            Index from = m_origin[i] - length * most;
            Index to = m_origin[i] - length * least;
            if (axis.cyclic && to - from + 1 >= axis.cells) {
                m_origin[i] = 0;
                return;
            }
            if (!axis.cyclic) {
                from = std::max<Index>(0, from);
                to = std::min(axis.cells - 1, to);
            }
            axis.cells = to - from + 1;
            axis.cyclic = false;
            m_origin[i] = from;
        }

        const Grid &m_grid;
        std::vector<Index> m_origin;
        std::vector<int> m_lowestRate;
        std::vector<Index> m_cells;
    };

    constexpr double scoreToleranceNats = 1e-4;
    constexpr Index historyFloats = Index(1) << 24;
    constexpr Index firstCorridorFrames = 8;

    /// Memory reused by consecutive corridors, because new pages cost as much as writing to them.
    class Storage
    {
    public:
        float *atLeast(Index size)
        {
            if (size > m_size) {
                m_values.reset(new float[std::size_t(size)]);
                m_size = size;
            }
            return m_values.get();
        }

    private:
        std::unique_ptr<float[]> m_values;
        Index m_size = 0;
    };

    /// Scores of the corridor's states in the newest frames, as many as fit into the reserved memory.
    class CorridorScores
    {
    public:
        CorridorScores(Index firstFrame, Index frameCount, Index states, Storage &storage)
            : m_states(states), m_room(std::clamp<Index>(historyFloats / states, 2, std::max<Index>(frameCount, 2))),
              m_firstFrame(firstFrame), m_end(firstFrame), m_values(storage.atLeast(m_room * states))
        {
        }

        Index firstFrame() const { return std::max(m_firstFrame, m_end - m_room); }
        std::span<float> at(Index frame) const
        {
            return {m_values + (frame - m_firstFrame) % m_room * m_states, std::size_t(m_states)};
        }
        std::span<float> append() { return at(m_end++); }

    private:
        Index m_states;
        Index m_room;
        Index m_firstFrame;
        Index m_end;
        float *m_values;
    };

    void forget(const CellBox &box, const Grid &grid, const TracedCorridor &corridor, std::span<float> scores)
    {
        box.forEachCell(grid, [&](Index cell) {
            const Index local = corridor.localCell(cell);
            for (Index plane = 0; local >= 0 && plane < corridor.space.planeCount(); ++plane) {
                float &score = scores[std::size_t(plane * corridor.space.cellCount() + local)];
                score = std::min(score, 0.0f);
            }
        });
    }

    /// Copies the corridor's part of the scores of all states.
    void take(std::span<const float> all, const MarkovModel &model, const TracedCorridor &corridor,
              std::span<float> scores)
    {
        const Index cells = corridor.space.cellCount();
        for (Index plane = 0; plane < corridor.space.planeCount(); ++plane) {
            const Index first = corridor.toGlobal(model.space, plane * cells) - corridor.cells().front();
            for (Index i = 0; i < cells; ++i)
                scores[std::size_t(plane * cells + i)] = all[std::size_t(first + corridor.cells()[std::size_t(i)])];
        }
    }

    /// Traces a path backwards from its end, corridor by corridor.
    class PathTracer
    {
    public:
        PathTracer(const MarkovModel &model, const Grid &grid, const RecursionRecord &record)
            : m_model(model), m_grid(grid), m_record(record)
        {
        }

        /// Returns the newest step first.
        std::vector<PathStep> trace(PathEnd end)
        {
            for (Index length = firstCorridorFrames; !m_isReset;) {
                const Beginning begin = beginningOf(end.frame, length);
                const TracedCorridor corridor(m_model, m_grid, end.state, end.frame - begin.frame);
                const CorridorScores history = run(corridor, begin, end.frame);
                const Index local = corridor.toLocal(m_model.space, end.state);
                // Paths that start outside the corridor are missing, so its score is at most the detector's.
                if (begin.isWithinRecord
                    && double(history.at(end.frame)[std::size_t(local)]) < end.score - scoreToleranceNats) {
                    length *= 2;
                    continue;
                }
                end = follow(corridor, history, begin, {end.frame, local, end.score});
                length = std::max(firstCorridorFrames, end.frame - begin.frame + 1);
            }
            return std::move(m_path);
        }

    private:
        /// The first frame of a corridor, and the scores of all states after it; without scores, paths start there.
        struct Beginning {
            Index frame;
            std::span<const float> scores{};
            bool isCheckpoint = false;
            bool isWithinRecord = false; ///< neither a checkpoint nor the record's own beginning
        };

        Beginning beginningOf(Index frame, Index length) const
        {
            const RecursionRecord::Checkpoint checkpoint =
                m_record.checkpoint ? m_record.checkpoint(frame) : RecursionRecord::Checkpoint{};
            if (checkpoint.frame >= std::max(m_record.firstFrame, frame - 2 * length))
                return {checkpoint.frame, checkpoint.scores, true, false};
            const Index known = frame - m_record.firstFrame + 1;
            return {frame - std::min(length, known) + 1, {}, false, length < known};
        }

        CorridorScores run(const TracedCorridor &corridor, const Beginning &begin, Index last)
        {
            Recursion<MaxPlus<float>> recursion(corridor.space, m_model.transitionScale);
            CorridorScores history(begin.frame, last - begin.frame + 1, corridor.space.stateCount(), m_storage);
            std::vector<float> y(std::size_t(corridor.space.cellCount()));
            std::vector<float> statistic(y.size());
            for (Index frame = begin.frame; frame <= last; ++frame) {
                const std::span<const float> whole = m_record.frame(frame);
                for (std::size_t i = 0; i < y.size(); ++i)
                    y[i] = whole[std::size_t(corridor.cells()[i])];
                const std::span<float> scores = history.append();
                if (frame == begin.frame) {
                    startScores(corridor, begin, y, scores);
                } else {
                    FrameJoin join;
                    join.counting = Counting::Nothing;
                    join.lnK = float(m_record.lnK(frame));
                    recursion.advance(history.at(frame - 1), scores, {y, statistic, frame}, m_model.likelihood, join);
                }
                if (frame < last)
                    for (const CellBox &box : m_record.forgotten(frame))
                        forget(box, m_grid, corridor, scores);
            }
            return history;
        }

        void startScores(const TracedCorridor &corridor, const Beginning &begin, std::span<const float> y,
                         std::span<float> scores) const
        {
            if (!begin.scores.empty()) {
                take(begin.scores, m_model, corridor, scores);
                return;
            }
            m_model.likelihood.apply(y, scores);
            const Index cells = corridor.space.cellCount();
            for (Index plane = 1; plane < corridor.space.planeCount(); ++plane)
                std::copy_n(scores.begin(), cells, scores.begin() + plane * cells);
        }

        /// Adds the path's steps from a local state back to its reset, or as far as the corridor reaches; returns the
        /// end of the remaining part.
        PathEnd follow(const TracedCorridor &corridor, const CorridorScores &history, const Beginning &begin,
                       PathEnd at)
        {
            while (!(begin.isCheckpoint && at.frame == begin.frame)) { // the previous corridor gives the rest
                const StepOrigin origin = at.frame == begin.frame
                                              ? StepOrigin{}
                                              : originOf(corridor, history.at(at.frame - 1), at.frame, at.state);
                m_path.push_back(stepInto(corridor.toGlobal(m_model.space, at.state), at.frame, origin));
                m_isReset = origin.state < 0;
                if (m_isReset)
                    return at;
                at.state = origin.state;
                --at.frame;
                if (at.frame == history.firstFrame() && at.frame > begin.frame)
                    break; // older scores are no longer stored: continue with a new corridor
            }
            return {at.frame, corridor.toGlobal(m_model.space, at.state),
                    double(history.at(at.frame)[std::size_t(at.state)])};
        }

        /// Origin of a step's maximum.
        struct StepOrigin {
            Index state = -1; ///< -1 if the path was reset there
            double lnTransition = 0.0;
        };

        StepOrigin originOf(const TracedCorridor &corridor, std::span<const float> before, Index frame,
                            Index state) const
        {
            StepOrigin best;
            float bestScore = unreached;
            for (const StateSpace::Predecessor &p : corridor.space.predecessors(state, frame)) {
                const double ln = p.lnProbability * m_model.transitionScale;
                const float score = before[std::size_t(p.state)] + float(ln);
                if (score > bestScore) {
                    bestScore = score;
                    best = {p.state, ln};
                }
            }
            return bestScore + float(m_record.lnK(frame)) > 0.0f ? best : StepOrigin{};
        }

        PathStep stepInto(Index state, Index frame, const StepOrigin &origin) const
        {
            PathStep step;
            step.frame = frame;
            step.state = state;
            const Index cell = m_model.space.cellOf(state);
            step.logLikelihoodRatio = m_model.likelihood.at(double(m_record.frame(frame)[std::size_t(cell)]));
            if (origin.state >= 0) {
                step.lnTransition = origin.lnTransition;
                step.lnK = m_record.lnK(frame);
            }
            return step;
        }

        const MarkovModel &m_model;
        const Grid &m_grid;
        const RecursionRecord &m_record;
        Storage m_storage;
        std::vector<PathStep> m_path;
        bool m_isReset = false;
    };

} // namespace

std::vector<PathStep> tracePath(const MarkovModel &model, const Grid &grid, const RecursionRecord &record, PathEnd end)
{
    std::vector<PathStep> path = PathTracer(model, grid, record).trace(end);
    std::reverse(path.begin(), path.end());
    double score = 0.0;
    for (PathStep &step : path) {
        score += step.logLikelihoodRatio + step.lnTransition + step.lnK;
        step.score = score;
    }
    return path;
}

/// One axis's part of the step: the best way into each state along it, with ties decided as in the recursion.
static void carryAlongAxis(const MarkovModel &model, std::size_t axis, Index step, const CarriedPaths &from,
                           CarriedPaths &to)
{
    const std::vector<KinematicAxis> &axes = model.space.axes();
    const KinematicAxis &own = axes[axis];
    Index inner = 1; // neighbours with the same coordinates on this axis
    Index outerCells = 1;
    Index innerRates = 1;
    Index outerRates = 1;
    for (const KinematicAxis &other : axes) {
        if (&other == &own)
            continue;
        (&other < &own ? outerCells : inner) *= other.cells;
        (&other < &own ? outerRates : innerRates) *= other.rateCount;
    }
    to.scores.assign(from.scores.size(), unreached);
    to.carried.assign(from.carried.size(), 0);
    const Index cells = model.space.cellCount();
    const auto plane = [&](Index outer, Index rate, Index innermost) {
        return ((outer * own.rateCount + rate) * innerRates + innermost) * cells;
    };
    const auto take = [&](Index target, Index source, Index count, float ln) {
        const float *score = from.scores.data() + source;
        const std::int32_t *carried = from.carried.data() + source;
        float *best = to.scores.data() + target;
        std::int32_t *brought = to.carried.data() + target;
        for (Index i = 0; i < count; ++i) {
            const float other = score[i] + ln;
            const bool isBetter = other > best[i];
            brought[i] = isBetter ? carried[i] : brought[i];
            best[i] = isBetter ? other : best[i];
        }
    };
    for (const KinematicAxis::Move &move : own.moves(step)) {
        const auto ln = float(move.lnProbability * model.transitionScale);
        const Index shift = move.cells;
        if (std::abs(shift) >= own.cells)
            continue;
        for (Index outerRate = 0; outerRate < outerRates; ++outerRate)
            for (Index innerRate = 0; innerRate < innerRates; ++innerRate)
                for (Index outer = 0; outer < outerCells; ++outer) {
                    const Index block = outer * own.cells * inner;
                    const Index target = plane(outerRate, move.toRate, innerRate) + block;
                    const Index source = plane(outerRate, move.fromRate, innerRate) + block;
                    take(target + std::max<Index>(shift, 0) * inner, source + std::max<Index>(-shift, 0) * inner,
                         (own.cells - std::abs(shift)) * inner, ln);
                    if (own.cyclic && shift > 0)
                        take(target, source + (own.cells - shift) * inner, shift * inner, ln);
                    if (own.cyclic && shift < 0)
                        take(target + (own.cells + shift) * inner, source, -shift * inner, ln);
                }
    }
}

void carryAlong(const MarkovModel &model, Index step, CarriedPaths &paths, CarriedPaths &scratch)
{
    for (std::size_t axis = model.space.axes().size(); axis-- > 0;) { // the last first: rates of the first decide ties
        carryAlongAxis(model, axis, step, paths, scratch);
        std::swap(paths, scratch);
    }
}

} // namespace faintline
