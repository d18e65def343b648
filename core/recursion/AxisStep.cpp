#include "recursion/AxisStep.h"

#include <algorithm>
#include <cstdlib>

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

} // namespace faintline
