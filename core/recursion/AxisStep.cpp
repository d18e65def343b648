#include "recursion/AxisStep.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace faintline {

namespace {

    using PhaseMoves = std::vector<KinematicAxis::Move>;

    /// An axis that never moves and loses no probability needs no step.
    bool isIdentity(const PhaseMoves &moves)
    {
        return std::all_of(moves.begin(), moves.end(), [](const KinematicAxis::Move &m) {
            return m.fromRate == m.toRate && m.cells == 0 && m.lnProbability == 0.0;
        });
    }

    template <class Semiring>
    auto firstStep(const KinematicAxis &axis, const PhaseMoves &moves, Index inner, double transitionScale)
    {
        AxisStep<typename Semiring::Real> step{axis.cells, inner, axis.cyclic};
        if (isIdentity(moves))
            return step;
        step.shifts.resize(std::size_t(axis.rateCount));
        for (const KinematicAxis::Move &move : moves)
            step.shifts[std::size_t(move.toRate)].push_back(
                {move.fromRate, move.cells, weightOf<Semiring>(move.lnProbability * transitionScale)});
        return step;
    }

    /// Position of a later axis among the others.
    struct Standing {
        Index inner;  ///< cells of the following axes
        Index before; ///< rate combinations within a group: of the later axes before this one …
        Index after;  ///< … and after it
    };

    template <class Semiring>
    auto laterStep(const KinematicAxis &axis, const PhaseMoves &moves, const Standing &at, double transitionScale)
    {
        using Real = typename Semiring::Real;
        const Index planes = at.before * axis.rateCount * at.after;
        AxisStep<Real> step{axis.cells, at.inner, axis.cyclic};
        step.shifts.resize(std::size_t(planes));
        for (Index b = 0; b < at.before; ++b)
            for (const KinematicAxis::Move &move : moves)
                for (Index c = 0; c < at.after; ++c) {
                    const auto plane = [&](Index rate) { return (b * axis.rateCount + rate) * at.after + c; };
                    Shift<Real> shift{plane(move.fromRate), move.cells,
                                      weightOf<Semiring>(move.lnProbability * transitionScale)};
                    if (move.cells != 0) {
                        const auto same = [&](const Shift<Real> &copy) {
                            return copy.from == shift.from && copy.cells == shift.cells;
                        };
                        const auto found = std::find_if(step.copies.begin(), step.copies.end(), same);
                        const Index copyNumber = planes + (found - step.copies.begin());
                        if (found == step.copies.end())
                            step.copies.push_back(shift);
                        shift = {copyNumber, 0, shift.weight};
                    }
                    step.shifts[std::size_t(plane(move.toRate))].push_back(shift);
                }
        return step;
    }

} // namespace

template <class Real>
Index PhaseSteps<Real>::reach() const
{
    Index largest = 0;
    for (const std::vector<Shift<Real>> &shifts : first.shifts)
        for (const Shift<Real> &shift : shifts)
            largest = std::max<Index>(largest, std::abs(shift.cells));
    return largest;
}

template <class Semiring>
PhaseSteps<typename Semiring::Real> stepsOfPhase(const StateSpace &space, Index phase, double transitionScale)
{
    const KinematicAxis &front = space.axes().front();
    Standing at{space.cellCount() / front.cells, 1, space.planeCount() / front.rateCount};
    PhaseSteps<typename Semiring::Real> steps{
        firstStep<Semiring>(front, front.moves(phase), at.inner, transitionScale)};
    for (auto axis = space.axes().begin() + 1; axis != space.axes().end(); ++axis) {
        at.inner /= axis->cells;
        at.after /= axis->rateCount;
        if (const PhaseMoves moves = axis->moves(phase); !isIdentity(moves))
            steps.later.push_back(laterStep<Semiring>(*axis, moves, at, transitionScale));
        at.before *= axis->rateCount;
    }
    return steps;
}

template <class Semiring>
void shiftCells(const AxisStep<typename Semiring::Real> &step, Index cells,
                std::span<const typename Semiring::Real> plane, typename Semiring::Real *to)
{
    const auto *const from = plane.data();
    const Index size = std::ssize(plane);
    const Index period = step.cells * step.inner;
    const Index by = std::clamp(cells, -step.cells, step.cells) * step.inner;
    // Copy as if all blocks were one, then correct the ends of the blocks.
    if (by > 0)
        std::copy_n(from, size - by, to + by);
    else
        std::copy_n(from - by, size + by, to);
    const Index wrong = std::abs(by);
    const Index first = by > 0 ? 0 : period - wrong;
    for (Index block = first; block < size; block += period) {
        if (step.cyclic) {
            for (Index i = 0; i < wrong; ++i)
                to[block + i] = from[block + i - by + (by > 0 ? period : -period)];
        } else {
            std::fill_n(to + block, wrong, neutral<Semiring>());
        }
    }
}

template struct PhaseSteps<float>;
template struct PhaseSteps<double>;
template PhaseSteps<float> stepsOfPhase<MaxPlus<float>>(const StateSpace &, Index, double);
template PhaseSteps<double> stepsOfPhase<MaxPlus<double>>(const StateSpace &, Index, double);
template PhaseSteps<double> stepsOfPhase<SumProduct>(const StateSpace &, Index, double);
template void shiftCells<MaxPlus<float>>(const AxisStep<float> &, Index, std::span<const float>, float *);
template void shiftCells<MaxPlus<double>>(const AxisStep<double> &, Index, std::span<const double>, double *);
template void shiftCells<SumProduct>(const AxisStep<double> &, Index, std::span<const double>, double *);

namespace {

    constexpr std::size_t sharedFromRates = 4; ///< number of rates from which sharing pays off

    template <class Real>
    using Shifts = std::vector<Shift<Real>>;

    template <class Real>
    bool isWorthSharing(const Shifts<Real> &shifts)
    {
        return shifts.size() >= sharedFromRates && std::all_of(shifts.begin(), shifts.end(), [&](const Shift<Real> &s) {
                   return s.weight == shifts.front().weight;
               });
    }

    /// Removes and returns the shifts that follow the first unused one, each two rates and one cell further.
    template <class Real>
    Shifts<Real> takeRun(const Shifts<Real> &all, std::size_t start, std::vector<bool> &used)
    {
        Shifts<Real> run{all[start]};
        for (std::size_t next = start + 1; next < all.size(); ++next)
            if (!used[next] && all[next].from == run.back().from + 2 && all[next].cells == run.back().cells + 1) {
                run.push_back(all[next]);
                used[next] = true;
            }
        return run;
    }

    /// The required maxima and their shifts.
    class Wanted
    {
    public:
        explicit Wanted(Index rates)
            : m_rates(rates), m_maxima(std::size_t(2 * rates), {-1, 0, 0, 0, 0, 0}), m_isMade(m_maxima.size(), false)
        {
        }

        Index ofTwo(Index rate, Index shift)
        {
            want({m_rates + rate, rate, rate + 2, 1, shift, shift});
            return m_rates + rate;
        }

        Index ofFour(Index rate, Index shift)
        {
            ofTwo(rate, shift);
            ofTwo(rate + 4, shift + 2);
            want({2 * m_rates + rate, m_rates + rate, m_rates + rate + 4, 2, shift, shift});
            return 2 * m_rates + rate;
        }

        /// Lists a maximum, preceded by its operands, unless it is already listed.
        void make(Index number, std::vector<SharedMaximum> &list)
        {
            if (number < m_rates || m_isMade[std::size_t(number - m_rates)])
                return;
            const SharedMaximum &maximum = m_maxima[std::size_t(number - m_rates)];
            make(maximum.of, list);
            make(maximum.other, list);
            m_isMade[std::size_t(number - m_rates)] = true;
            list.push_back(maximum);
        }

        std::vector<Index> largestShifts() const
        {
            std::vector<Index> largest;
            for (const SharedMaximum &maximum : m_maxima)
                largest.push_back(maximum.largest);
            return largest;
        }

    private:
        void want(const SharedMaximum &at)
        {
            SharedMaximum &maximum = m_maxima[std::size_t(at.number - m_rates)];
            const bool isNew = maximum.number < 0;
            const Index smallest = isNew ? at.smallest : std::min(maximum.smallest, at.smallest);
            const Index largest = isNew ? at.largest : std::max(maximum.largest, at.largest);
            maximum = {at.number, at.of, at.other, at.back, smallest, largest};
        }

        Index m_rates;
        std::vector<SharedMaximum> m_maxima;
        std::vector<bool> m_isMade;
    };

    template <class Real>
    Shifts<Real> replaced(const Shifts<Real> &all, Wanted &wanted)
    {
        Shifts<Real> result;
        std::vector<bool> used(all.size(), false);
        for (std::size_t start = 0; start < all.size(); ++start) {
            if (used[start])
                continue;
            const Shifts<Real> run = takeRun(all, start, used);
            const std::size_t length = run.size() >= 4 ? 4 : run.size() >= 2 ? 2 : 1;
            for (std::size_t at = 0; at < run.size(); at += length) {
                const Shift<Real> &begin = run[std::min(at, run.size() - length)];
                Index from = begin.from;
                if (length > 1)
                    from = length == 4 ? wanted.ofFour(begin.from, begin.cells) : wanted.ofTwo(begin.from, begin.cells);
                result.push_back({from, begin.cells, begin.weight});
            }
        }
        return result;
    }

} // namespace

Index SharedMaxima::longestSpan() const
{
    Index longest = 0;
    for (const std::vector<SharedMaximum> &maxima : before)
        for (const SharedMaximum &maximum : maxima)
            longest = std::max(longest, maximum.largest - maximum.smallest);
    return longest;
}

template <class Real>
SharedMaxima shareMaxima(AxisStep<Real> &step, bool keepsAll)
{
    const Index rates = std::ssize(step.shifts);
    Wanted wanted(rates);
    std::vector<Shifts<Real>> all = step.shifts;
    for (Shifts<Real> &shifts : all)
        if (isWorthSharing(shifts))
            shifts = replaced(shifts, wanted);
    SharedMaxima result;
    result.before.resize(std::size_t(rates));
    bool isAny = false;
    for (std::size_t rate = 0; rate < all.size(); ++rate) { // just before the first target that uses it
        for (const Shift<Real> &shift : all[rate])
            wanted.make(shift.from, result.before[rate]);
        isAny = isAny || !result.before[rate].empty();
    }
    if (!isAny)
        return result;
    result.largest = wanted.largestShifts();
    for (std::size_t rate = 0; rate < all.size(); ++rate)
        for (const Shift<Real> &shift : step.shifts[rate])
            result.ring = std::max(result.ring, 2 * std::abs(shift.from - Index(rate)) + 1);
    if (keepsAll)
        result.ring = rates;
    step.shifts = std::move(all);
    return result;
}

template SharedMaxima shareMaxima(AxisStep<float> &, bool);
template SharedMaxima shareMaxima(AxisStep<double> &, bool);

template <class Semiring>
TiledPlanes<Semiring>::TiledPlanes(const PlaneShape &shape, Index reach, Index tileRows)
    : m_shape(shape), m_reach(reach), m_edgeRows(2 * reach + 2 * tileRows >= shape.rows ? shape.rows : reach)
{
    const auto cut = [&](Index from, Index to) {
        for (; from < to; from += tileRows)
            m_tiles.push_back({from, std::min(tileRows, to - from)});
    };
    if (m_edgeRows == shape.rows) {
        cut(0, shape.rows);
    } else {
        cut(0, m_edgeRows);
        cut(m_edgeRows, shape.rows - m_edgeRows);
        cut(shape.rows - m_edgeRows, shape.rows);
    }
    if (m_reach > 0) {
        const Index rows = m_edgeRows == shape.rows ? shape.rows + 2 * m_reach : 2 * (m_edgeRows + 2 * m_reach);
        m_margins.resize(std::size_t(shape.planes * rows * shape.inner));
    }
}

/// Copies rows beyond and near the ends of the first axis: rows -reach … edge+reach and the same at the other end, or
/// all.
template <class Semiring>
void TiledPlanes<Semiring>::fillMargins(std::span<const Real> scores)
{
    if (m_reach == 0)
        return;
    const Index cells = m_shape.rows;
    const Index inner = m_shape.inner;
    Real *to = m_margins.data();
    const auto copyRows = [&](const Real *plane, Index from, Index end) {
        for (Index row = from; row < end;) {
            const bool isInside = row >= 0 && row < cells;
            const Index next = row < 0 ? std::min<Index>(0, end) : row < cells ? std::min(cells, end) : end;
            const Index wrapped = row < 0 ? row + cells : row - cells;
            const Index n = (next - row) * inner;
            if (isInside)
                std::copy_n(plane + row * inner, n, to);
            else if (m_shape.isCyclic)
                std::copy_n(plane + wrapped * inner, n, to);
            else
                std::fill_n(to, n, neutral<Semiring>());
            to += n;
            row = next;
        }
    };
    for (Index number = 0; number < m_shape.planes; ++number) {
        const Real *plane = scores.data() + number * m_shape.size();
        if (m_edgeRows == cells) {
            copyRows(plane, -m_reach, cells + m_reach);
        } else {
            copyRows(plane, -m_reach, m_edgeRows + m_reach);
            copyRows(plane, cells - m_edgeRows - m_reach, cells + m_reach);
        }
    }
}

/// Pointer to a plane's rows from firstRow on, with `reach` more on either side of the tile.
template <class Semiring>
const typename Semiring::Real *TiledPlanes<Semiring>::rowsOf(std::span<const Real> scores, Index plane,
                                                             Index firstRow) const
{
    const Index cells = m_shape.rows;
    const bool isLow = firstRow < m_edgeRows;
    if (m_reach == 0 || (!isLow && firstRow < cells - m_edgeRows))
        return scores.data() + plane * m_shape.size() + firstRow * m_shape.inner;
    const bool isWhole = m_edgeRows == cells;
    const Index rows = m_edgeRows + 2 * m_reach;
    const Index block = isWhole || isLow ? 0 : rows;
    const Index begin = isWhole || isLow ? -m_reach : cells - m_edgeRows - m_reach;
    return m_margins.data() + (plane * (isWhole ? rows : 2 * rows) + block + firstRow - begin) * m_shape.inner;
}

template class TiledPlanes<MaxPlus<float>>;
template class TiledPlanes<MaxPlus<double>>;
template class TiledPlanes<SumProduct>;

} // namespace faintline
