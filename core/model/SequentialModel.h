#pragma once

#include "base/Axis.h"
#include "model/MarkovModel.h"

#include <span>
#include <string>
#include <vector>

namespace faintline {

/// Frame axes along which a target is uniform and independent at each stage, such as a radar's ambiguous Doppler. They
/// need no state.
///
/// With P(p'|p) = 1/N_d along such axes, the sum over trajectories of a product of p1/p0 factorises stage by stage, and
/// so does the maximum; the recursion runs on the other axes only, on
///
///   sum:  λ(cell) = ln [ 1/N_d · Σ_d e^{λ(cell, d)} ]          maximum:  λ(cell) = max_d λ(cell, d) - ln N_d
///
/// λ = ln p1/p0 of each frame cell, N_d the number of cells folded into one. Source: Grossi and Lops 2006, section 4.3.
/// Oracle: enumeration of all trajectories in the unreduced space. Ties: the lowest d. Immutable, thread-safe.
class CellReduction
{
public:
    CellReduction() = default;
    /// Number of cells of each frame axis, slowest first, and which axes are folded.
    CellReduction(std::vector<Index> cells, const std::vector<bool> &isFolded);

    const std::vector<Index> &axisCells() const { return m_cells; } ///< of the frame, including folded axes
    bool isFolded(std::size_t axis) const { return m_isFolded[axis]; }
    Index frameCells() const { return m_frameCells; }
    Index stateCells() const { return m_stateCells; }
    Index foldedCells() const { return m_frameCells / m_stateCells; } ///< N_d

    /// Reduces frameCells values to stateCells values.
    void sum(std::span<const double> lambda, std::span<double> reduced) const;
    void maximum(std::span<const double> lambda, std::span<double> reduced) const;

    /// Frame coordinates of the cell with the largest λ among those folded into `stateCell`.
    std::vector<Index> best(std::span<const double> lambda, Index stateCell) const;

private:
    std::vector<Index> m_cells;
    std::vector<bool> m_isFolded;
    std::vector<Index> m_stateCell; ///< for each frame cell
    Index m_frameCells = 1;
    Index m_stateCells = 1;
};

/// Model of a sequential test: a Markov model of the target, its initial law, and the frame axes without a state.
///
/// Its law is stochastic: for each state, the probabilities of the possible moves add up to 1, including rates and the
/// ends of an axis. Otherwise E0[Λ_k] would fall from stage to stage (by 9 % with five slopes, h = ⅓), and every test
/// would drift to "no target".
struct SequentialModel {
    MarkovModel markov;          ///< on the frame axes that are not folded; one cell if all are
    CellReduction reduction;     ///< from frame cells to model cells
    std::vector<double> initial; ///< P(x1) of each state in StateSpace order; empty: uniform
    /// Interval of observed frames, starting with the first. Frames between them share samples with them (overlapping
    /// windows), but the evidence of stages must be independent. The target moves through them unseen, λ = 0.
    Index observedEvery = 1;

    /// P(x1) of each state, also if uniform.
    std::vector<double> initialLaw() const;

    /// Throws Error naming `where` if the initial law is not a probability law, cells do not match, or the law of an
    /// axis loses probability.
    void check(const std::string &where) const;
};

/// The model on these frame axes (slowest first). Axes marked in `isFolded` are uniform and independent at each stage;
/// the others are made stochastic (KinematicAxis::stochastic). The sum of the initial law must be 1, apart from
/// rounding. Throws Error.
SequentialModel makeSequentialModel(const std::vector<KinematicAxis> &frameAxes, const std::vector<bool> &isFolded,
                                    const Likelihood &likelihood, std::vector<double> initial = {});

} // namespace faintline
