#include "app/cli/speed/plainForms.h"

#include "base/multiversion.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr double minus = -std::numeric_limits<double>::infinity();

    /// Number of cells of the last axis, which is contiguous in memory, and of the one before it (1 if there is none).
    Index columnsOf(const StateSpace &space)
    {
        return space.axes().size() > 1 ? space.axes()[1].cells : 1;
    }

    std::vector<KinematicAxis::Move> movesAlong(const StateSpace &space, std::size_t axis, Index step)
    {
        if (axis < space.axes().size())
            return space.axes()[axis].moves(step);
        return {{0, 0, 0, 0.0}};
    }

    Index ratesAlong(const StateSpace &space, std::size_t axis)
    {
        return axis < space.axes().size() ? space.axes()[axis].rateCount : 1;
    }

} // namespace

FormulaRecursion::FormulaRecursion(const StateSpace &space, double lnK)
    : m_space(space), m_lnK(lnK), m_scores(std::size_t(space.stateCount())), m_next(m_scores.size())
{
    for (Index phase = 0; phase < space.phaseCount(); ++phase) {
        Moves &moves = m_moves.emplace_back();
        for (std::size_t axis = 0; axis < 2; ++axis) {
            moves[axis].resize(std::size_t(ratesAlong(space, axis)));
            for (const KinematicAxis::Move &move : movesAlong(space, axis, phase))
                moves[axis][std::size_t(move.toRate)].push_back(move);
        }
    }
}

double FormulaRecursion::bestOfLine(const std::vector<KinematicAxis::Move> &moves, Index cell) const
{
    const KinematicAxis &axis = m_space.axes()[0];
    double best = minus;
    for (const KinematicAxis::Move &move : moves) {
        Index from = cell - move.cells;
        if (axis.cyclic)
            from = (from + axis.cells) % axis.cells;
        if (from >= 0 && from < axis.cells)
            best = std::max(best, m_scores[std::size_t(move.fromRate * axis.cells + from)] + move.lnProbability);
    }
    return best;
}

double FormulaRecursion::bestOfPlane(const std::vector<KinematicAxis::Move> &alongFirst,
                                     const std::vector<KinematicAxis::Move> &alongSecond, Index row, Index column) const
{
    const KinematicAxis &first = m_space.axes()[0];
    const KinematicAxis &second = m_space.axes()[1];
    double best = minus;
    for (const KinematicAxis::Move &a : alongFirst)
        for (const KinematicAxis::Move &b : alongSecond) {
            Index fromRow = row - a.cells;
            Index fromColumn = column - b.cells;
            if (first.cyclic)
                fromRow = (fromRow + first.cells) % first.cells;
            if (second.cyclic)
                fromColumn = (fromColumn + second.cells) % second.cells;
            if (fromRow < 0 || fromRow >= first.cells || fromColumn < 0 || fromColumn >= second.cells)
                continue;
            const Index plane = a.fromRate * second.rateCount + b.fromRate;
            const Index from = (plane * first.cells + fromRow) * second.cells + fromColumn;
            best = std::max(best, m_scores[std::size_t(from)] + a.lnProbability + b.lnProbability);
        }
    return best;
}

void FormulaRecursion::update(std::span<const float> y, std::span<float> statistic)
{
    std::fill(statistic.begin(), statistic.end(), -std::numeric_limits<float>::infinity());
    const Index columns = columnsOf(m_space);
    const Moves &moves = m_moves[std::size_t(m_frames) % m_moves.size()];
    std::size_t state = 0;
    for (const auto &alongFirst : moves[0])
        for (const auto &alongSecond : moves[1])
            for (Index row = 0; row < m_space.axes()[0].cells; ++row)
                for (Index column = 0; column < columns; ++column, ++state) {
                    double continued = 0.0;
                    if (m_frames > 0) {
                        const double best = columns > 1 ? bestOfPlane(alongFirst, alongSecond, row, column)
                                                        : bestOfLine(alongFirst, row);
                        continued = std::max(m_lnK + best, 0.0);
                    }
                    const auto cell = std::size_t(row * columns + column);
                    m_next[state] = double(y[cell]) + continued;
                    statistic[cell] = std::max(statistic[cell], float(m_next[state]));
                }
    std::swap(m_scores, m_next);
    ++m_frames;
}

EigenRecursion::EigenRecursion(const StateSpace &space, float lnK) : m_lnK(lnK)
{
    // Arrays lie along the last axis; a single axis is that one.
    const std::size_t count = space.axes().size();
    for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t axis = count == 1 ? 1 - i : i;
        m_rates[i] = ratesAlong(space, axis);
        m_cells[i] = axis < count ? space.axes()[axis].cells : 1;
        m_cyclic[i] = axis < count && space.axes()[axis].cyclic;
        m_margin[i] = axis < count ? space.axes()[axis].largestDisplacement() : 0;
    }
    for (Index phase = 0; phase < space.phaseCount(); ++phase)
        m_phases.push_back(stepsOf(space, phase));
    const Plane nothing = Plane::Constant(m_cells[1] + 2 * m_margin[1], m_cells[0] + 2 * m_margin[0],
                                          -std::numeric_limits<float>::infinity());
    m_scores.assign(std::size_t(m_rates[0] * m_rates[1]), nothing);
    m_next = m_scores;
}

std::vector<EigenRecursion::Step> EigenRecursion::stepsOf(const StateSpace &space, Index phase) const
{
    std::array<std::vector<KinematicAxis::Move>, 2> moves;
    for (std::size_t i = 0; i < 2; ++i)
        moves[i] = movesAlong(space, space.axes().size() == 1 ? 1 - i : i, phase);
    std::vector<Step> steps;
    const auto emptyStep = Step(std::size_t(m_rates[0] * m_rates[1]));
    const auto plane = [&](Index a, Index b) { return std::size_t(a * m_rates[1] + b); };
    if (std::ssize(moves[0]) == m_rates[0]
        || std::ssize(moves[1]) == m_rates[1]) { // along one of them from one rate: in one expression
        steps.push_back(emptyStep);
        for (const KinematicAxis::Move &a : moves[0])
            for (const KinematicAxis::Move &b : moves[1])
                steps.back()[plane(a.toRate, b.toRate)].push_back(
                    {plane(a.fromRate, b.fromRate), {a.cells, b.cells}, float(a.lnProbability + b.lnProbability)});
    } else {
        steps.assign(2, emptyStep);
        for (const KinematicAxis::Move &a : moves[0])
            for (Index b = 0; b < m_rates[1]; ++b)
                steps[0][plane(a.toRate, b)].push_back({plane(a.fromRate, b), {a.cells, 0}, float(a.lnProbability)});
        for (const KinematicAxis::Move &b : moves[1])
            for (Index a = 0; a < m_rates[0]; ++a)
                steps[1][plane(a, b.toRate)].push_back({plane(a, b.fromRate), {0, b.cells}, float(b.lnProbability)});
    }
    return steps;
}

void EigenRecursion::fillMargins(Plane &plane) const
{
    if (const Index m = m_margin[0]; m > 0 && m_cyclic[0]) {
        plane.leftCols(m) = plane.middleCols(m_cells[0], m).eval();
        plane.rightCols(m) = plane.middleCols(m, m).eval();
    }
    if (const Index m = m_margin[1]; m > 0 && m_cyclic[1]) {
        plane.topRows(m) = plane.middleRows(m_cells[1], m).eval();
        plane.bottomRows(m) = plane.middleRows(m, m).eval();
    }
}

void EigenRecursion::join(const std::vector<Source> &sources, Plane &to)
{
    const auto from = [&](std::size_t k) {
        return inner(m_scores[sources[k].plane], sources[k].shift) + sources[k].weight;
    };
    auto target = inner(to, {0, 0});
    if (sources.size() == 1)
        target = from(0);
    else if (sources.size() == 2)
        target = from(0).max(from(1));
    else
        target = from(0).max(from(1)).max(from(2));
    for (std::size_t k = 3; k < sources.size(); ++k)
        target = target.max(from(k));
}

void EigenRecursion::update(std::span<const float> y, std::span<float> statistic)
{
    const Eigen::Map<const Eigen::ArrayXXf> lambda(y.data(), m_cells[1], m_cells[0]);
    Eigen::Map<Eigen::ArrayXXf> best(statistic.data(), m_cells[1], m_cells[0]);
    best.setConstant(-std::numeric_limits<float>::infinity());
    const std::vector<Step> &steps = m_phases[std::size_t(m_frames) % m_phases.size()];
    for (std::size_t step = 0; step < steps.size(); ++step) {
        for (std::size_t plane = 0; plane < m_next.size(); ++plane) {
            join(steps[step][plane], m_next[plane]);
            if (step + 1 == steps.size()) {
                auto u = inner(m_next[plane], {0, 0});
                if (m_frames == 0)
                    u = lambda;
                else
                    u = (u + m_lnK).max(0.0f) + lambda;
                best = best.max(u);
            }
            fillMargins(m_next[plane]);
        }
        std::swap(m_scores, m_next);
    }
    ++m_frames;
}

float EigenRecursion::score(Index plane, Index cell) const
{
    return m_scores[std::size_t(plane)](m_margin[1] + cell % m_cells[1], m_margin[0] + cell / m_cells[1]);
}

FAINTLINE_MULTIVERSION
void sweep(std::span<float> values)
{
    float *data = values.data();
    const std::size_t n = values.size();
    for (std::size_t i = 0; i < n; ++i)
        data[i] = 0.5f * data[i] + 1.0f;
}

DenseSumProduct::DenseSumProduct(const StateSpace &space)
    : m_states(std::size_t(space.stateCount())), m_probabilities(m_states * m_states), m_product(m_states)
{
    for (std::size_t to = 0; to < m_states; ++to)
        for (const StateSpace::Predecessor &from : space.predecessors(Index(to)))
            m_probabilities[to * m_states + std::size_t(from.state)] += std::exp(from.lnProbability);
}

void DenseSumProduct::update(std::vector<double> &weights)
{
    for (std::size_t to = 0; to < m_states; ++to) {
        double sum = 0.0;
        for (std::size_t from = 0; from < m_states; ++from)
            sum += m_probabilities[to * m_states + from] * weights[from];
        m_product[to] = sum;
    }
    std::swap(weights, m_product);
}

} // namespace faintline
