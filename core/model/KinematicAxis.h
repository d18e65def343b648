#pragma once

#include "base/Axis.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// How the mean rate (r + r')/2 is rounded to a whole number of cells.
enum class Rounding {
    HalfDown, ///< Billon's half-open interval -½ ≤ p' - p - (r + r')/2 < ½: halves go down
    Trunc     ///< Parsons: toward zero
};

inline constexpr std::array<std::string_view, 2> roundingNames{"halfDown", "trunc"};

/// How one coordinate of the state moves in one step, in cells and cells per step.
///
/// With rates r in firstRate … firstRate+rateCount-1:
///
///   r' = r + δ with probability h(|δ|),   p' = p + round((r + r')/2)
///
/// With `ratesPerCell` = q > 1, rates are integer multiples k of 1/q cell per step. The target rate alone moves it, as
/// in Bresenham's line, in step t = 0, 1, …:
///
///   p' = p + ⌊k'(t + 1)/q + ½⌋ - ⌊k'·t/q + ½⌋
///
/// A state that keeps its rate stays within half a cell of a straight line; the phase t mod q is common to all states,
/// so it costs neither states nor probability. Without rates (rateCount = 1, firstRate = 0) and with a step law q, the
/// axis is a random walk:
///
///   p' = p + δ with probability q(|δ|)
///
/// h(0) + 2 Σ h(i) = 1, and the same for q. Rates outside the set, and positions outside a bounded axis, do not exist;
/// the probability lost there is not redistributed (Billon 2005 section 4, Parsons 2008 section 3): in a detector K
/// absorbs the loss.
///
/// A likelihood ratio needs a lossless law. On a `renormalised` axis the existing moves share the lost probability,
///
///   P(r', p' | r, p) = h(|r'-r|) / Σ h(|r''-r|)   over r'' with p + d(r, r'') on the axis
///   P(p'|p) = q(|p'-p|) / Σ q(|p''-p|)            over cells p'' that exist
///
/// (Grossi and Lops 2006 for walks), so P = (departure of the source) · (law of the move). At the end of an axis, a
/// target none of whose moves stays on it first takes the nearest rate that has one, the lower of two equally near
/// ones. For small cases a full matrix may replace the law: P(p'|p) = transition[p·cells + p'].
struct KinematicAxis {
    std::string name{};
    Index cells = 0;
    bool cyclic = false;
    int firstRate = 0; ///< in 1/ratesPerCell cell per step
    int rateCount = 1;
    std::vector<double> rateChange{1.0}; ///< h(0), h(1), …
    std::vector<double> step{};          ///< q(0), q(1), … of a random walk; empty: no walk
    Rounding rounding = Rounding::HalfDown;
    bool renormalised = false; ///< existing moves share the probability of non-existing ones
    int ratesPerCell = 1;      ///< q: neighbouring rates differ by 1/q cell per step
    /// P(from, to) of a bounded axis without rates, cells × cells row by row; empty: a law is used.
    std::vector<double> transition{};

    /// One move: from a rate to a rate (indices 0 … rateCount-1) by a number of cells, with ln probability.
    struct Move {
        int fromRate;
        int toRate;
        int cells;
        double lnProbability;
    };

    /// All moves in step number `step`, ordered by target rate, then source rate, then decreasing displacement, so that
    /// among equals the lowest rate, then the lowest source cell comes first. Moves ignore a transition matrix: an axis
    /// that has one gives the move that stays.
    std::vector<Move> moves(Index step = 0) const;

    /// Displacement, in cells, of a move between two rates (indices) in step number `step`.
    int displacement(int fromRate, int toRate, Index step = 0) const;

    /// Number of steps after which the moves repeat.
    Index phaseCount() const { return ratesPerCell; }

    /// Rate of an index, in cells per step.
    double rate(Index index) const { return double(firstRate + index) / ratesPerCell; }

    /// Σ of the law's probabilities over the existing moves from a cell and a rate (index) in step number `step`; 0 if
    /// there is none.
    double remaining(Index fromCell, int fromRate = 0, Index step = 0) const;

    /// The rate with which a target continues: its own, or the nearest one with a move if its own has none on a
    /// renormalised axis.
    int rateGoingOn(Index cell, int rate, Index step = 0) const;

    /// Addition to a move's ln probability: -ln of the remaining probability if renormalised, otherwise 0.
    double lnDeparture(Index fromCell, int fromRate = 0, Index step = 0) const;

    /// Number of cells at either end of a bounded axis where the remaining probability of a law with rates may differ
    /// from that in the middle.
    Index edgeCells() const;

    /// The same motion without loss: renormalised if the law is not stochastic; a matrix row by row. Throws Error
    /// naming `where` if some cell has no move.
    KinematicAxis stochastic(const std::string &where) const;

    /// Largest |1 - Σ P| over the states a target may be in; 0, apart from rounding, if the law is stochastic.
    double largestLoss() const;

    /// Whether the law differs from cell to cell, so that a part of the axis has another law than the whole.
    bool isPlaceDependent() const { return (renormalised && !cyclic) || !transition.empty(); }

    /// Largest displacement |p' - p| of any move in any step.
    int largestDisplacement() const;

    /// Throws Error naming `where` if a law is not a probability law or a size is invalid.
    void check(const std::string &where) const;

    bool operator==(const KinematicAxis &) const = default;
};

/// Step law of a random walk with a standard deviation of `deviation` cells, q(d) = Φ((d + ½)/σ) - Φ((d - ½)/σ),
/// truncated to an axis of `cells` cells and to q above 1e-17 of its maximum; to be renormalised. σ = 0 stays in place,
/// σ = ∞ is uniform. Source: Grossi and Lops 2006, section 4.2.
std::vector<double> gaussianStep(double deviation, Index cells);

} // namespace faintline
