#pragma once

#include "base/Axis.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace faintline {

/// How the mean rate (r + r')/2 becomes a whole number of cells.
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
/// With `ratesPerCell` = q > 1 rates are whole multiples k of 1/q cell per step, and the target's moves it as
/// Bresenham's line does, in step t = 0, 1, … independent of the previous rate:
///
///   p' = p + ⌊k'(t + 1)/q + ½⌋ - ⌊k'·t/q + ½⌋
///
/// A state that keeps its rate stays within half a cell of a straight line; the phase t mod q is common to all states,
/// so it costs neither states nor probability. Without rates (rateCount = 1, firstRate = 0) and with a step law q, a
/// random walk:
///
///   p' = p + δ with probability q(|δ|)
///
/// h(0) + 2 Σ h(i) = 1, the same for q. Rates outside the set do not exist; neither do positions outside a bounded
/// axis; the probability lost there is not given to others (Billon 2005 section 4, Parsons 2008 section 3): K absorbs
/// that in a detector.
///
/// A likelihood ratio needs a lossless law. On a `renormalised` axis the moves that exist share what is lost,
///
///   P(r', p' | r, p) = h(|r'-r|) / Σ h(|r''-r|)   over r'' with p + d(r, r'') on the axis
///   P(p'|p) = q(|p'-p|) / Σ q(|p''-p|)            over cells p'' that exist
///
/// (Grossi and Lops 2006 for walks), so P = (departure of the source) · (law of the move). A target at the end of an
/// axis none of whose moves stays there first turns to the rate nearest to its own that has one, of two equally near
/// ones the lower. For small cases a full matrix may stand in place of a law: P(p'|p) = transition[p·cells + p'].
struct KinematicAxis {
    std::string name;
    Index cells = 0;
    bool cyclic = false;
    int firstRate = 0; ///< in 1/ratesPerCell cell per step
    int rateCount = 1;
    std::vector<double> rateChange{1.0}; ///< h(0), h(1), …
    std::vector<double> step;            ///< q(0), q(1), … of a random walk; empty: no walk
    Rounding rounding = Rounding::HalfDown;
    bool renormalised = false; ///< the moves that exist share the probability of those that do not
    int ratesPerCell = 1;      ///< q: neighbouring rates differ by 1/q cell per step
    /// P(from, to), cells × cells row by row, of a bounded axis without rates; empty: a law.
    std::vector<double> transition{};

    /// One way to move: from a rate to a rate (indices 0 … rateCount-1) by whole cells, with ln probability.
    struct Move {
        int fromRate;
        int toRate;
        int cells;
        double lnProbability;
    };

    /// All moves in step number `step`, ordered by target rate, then source rate, then decreasing displacement, so that
    /// among equals the lowest rate, then the lowest source cell comes first. Of an axis with a matrix, which they know
    /// nothing of: staying.
    std::vector<Move> moves(Index step = 0) const;

    /// By how many cells a move between two rates (indices) goes in step number `step`.
    int displacement(int fromRate, int toRate, Index step = 0) const;

    /// Number of steps after which the moves repeat.
    Index phaseCount() const { return ratesPerCell; }

    /// A rate by its index, in cells per step.
    double rate(Index index) const { return double(firstRate + index) / ratesPerCell; }

    /// Σ of the law's probabilities over the moves that exist from a cell and a rate (index) in step number `step`; 0
    /// if no move exists.
    double remaining(Index fromCell, int fromRate = 0, Index step = 0) const;

    /// The rate with which a target continues: its own, or on a renormalised axis where that has no move, the nearest
    /// that has one.
    int rateGoingOn(Index cell, int rate, Index step = 0) const;

    /// What a move has on top of its ln probability: -ln of what remains where renormalised, otherwise 0.
    double lnDeparture(Index fromCell, int fromRate = 0, Index step = 0) const;

    /// Cells at either end of a bounded axis where what remains of a law with rates may differ from that in the middle.
    Index edgeCells() const;

    /// The same motion, losing nothing: renormalised where the law is not stochastic as it stands, a matrix row by row.
    /// Throws Error naming `where` if some cell has no way on.
    KinematicAxis stochastic(const std::string &where) const;

    /// Largest |1 - Σ P| over the states a target may be in: 0 but for rounding where the law is stochastic.
    double largestLoss() const;

    /// Whether the law differs from cell to cell; then a part of the axis has another law than the whole.
    bool isPlaceDependent() const { return (renormalised && !cyclic) || !transition.empty(); }

    /// Largest displacement |p' - p| of any move in any step.
    int largestDisplacement() const;

    /// Throws Error naming `where` if the laws are no probability laws or the sizes make no sense.
    void check(const std::string &where) const;

    bool operator==(const KinematicAxis &) const = default;
};

/// Step law of a random walk in `deviation` cells, q(d) = Φ((d + ½)/σ) - Φ((d - ½)/σ), truncated to an axis of `cells`
/// cells and q exceeds 1e-17 of its maximum; to be renormalised. σ = 0 stays, σ = ∞ is uniform. Source: Grossi and Lops
/// 2006, section 4.2.
std::vector<double> gaussianStep(double deviation, Index cells);

} // namespace faintline
