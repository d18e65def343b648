#pragma once

#include "model/MarkovModel.h"

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

namespace faintline {

// The recursion u = λ + max(ln K + max_m [ln P(n|m) + u(m)], 0), D = max over rates, in straightforward implementations
// that serve as reference for speed and results of the fast form. λ is y itself. For one or two axes with rates.

/// In double precision, state by state, predecessor by predecessor. Not for axes whose law differs from cell to cell.
class FormulaRecursion
{
public:
    FormulaRecursion(const StateSpace &space, double lnK);

    void update(std::span<const float> y, std::span<float> statistic);
    std::span<const double> scores() const { return m_scores; }

private:
    double bestOfLine(const std::vector<KinematicAxis::Move> &moves, Index cell) const;
    double bestOfPlane(const std::vector<KinematicAxis::Move> &alongFirst,
                       const std::vector<KinematicAxis::Move> &alongSecond, Index row, Index column) const;

    StateSpace m_space;
    using Moves = std::array<std::vector<std::vector<KinematicAxis::Move>>, 2>; ///< for each axis, by target rate
    std::vector<Moves> m_moves;                                                 ///< for each phase
    double m_lnK;
    std::vector<double> m_scores;
    std::vector<double> m_next;
    Index m_frames = 0; ///< number taken
};

/// In single precision, as Eigen expressions over whole planes: the maximum of shifted arrays, whose margins hold -∞ or
/// wrapped values.
class EigenRecursion
{
public:
    EigenRecursion(const StateSpace &space, float lnK);

    void update(std::span<const float> y, std::span<float> statistic);
    float score(Index plane, Index cell) const;

private:
    using Plane = Eigen::ArrayXXf; ///< cells of the second axis × cells of the first, with margins

    struct Source {
        std::size_t plane;
        std::array<Index, 2> shift;
        float weight;
    };
    using Step = std::vector<std::vector<Source>>; ///< for each target plane

    auto inner(Plane &plane, std::array<Index, 2> shift) const
    {
        return plane.block(m_margin[1] - shift[1], m_margin[0] - shift[0], m_cells[1], m_cells[0]);
    }
    std::vector<Step> stepsOf(const StateSpace &space, Index phase) const;
    void join(const std::vector<Source> &sources, Plane &to);
    void fillMargins(Plane &plane) const;

    std::array<Index, 2> m_rates{};
    std::array<Index, 2> m_cells{};
    std::array<bool, 2> m_cyclic{};
    std::array<Index, 2> m_margin{};
    std::vector<std::vector<Step>> m_phases; ///< for each phase, one axis after the other, or both at once
    float m_lnK;
    std::vector<Plane> m_scores;
    std::vector<Plane> m_next;
    Index m_frames = 0; ///< number taken
};

/// Reads, modifies and writes each value once: the cost of memory access alone.
void sweep(std::span<float> values);

/// u = e^λ Pu with an explicit matrix P, the scaled form of the sum-product recursion: a matrix-vector product.
class DenseSumProduct
{
public:
    explicit DenseSumProduct(const StateSpace &space);
    void update(std::vector<double> &weights);

private:
    std::size_t m_states;
    std::vector<double> m_probabilities; ///< P(to, from), row by row
    std::vector<double> m_product;
};

} // namespace faintline
