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
/// With rates r in firstRate … firstRate+rateCount-1:   r' = r + δ with probability h(|δ|),   p' = p + round((r + r')/2).
/// Without (rateCount = 1, firstRate = 0) and with a step law q:   p' = p + δ with probability q(|δ|), a random walk.
/// h(0) + 2 Σ h(i) = 1, the same for q. Rates outside the set do not exist; neither do positions outside a bounded axis;
/// the probability lost there is not given to others (Billon 2005 section 4, Parsons 2008 section 3).
struct KinematicAxis {
    std::string name;
    Index cells = 0;
    bool cyclic = false;
    int firstRate = 0;
    int rateCount = 1;
    std::vector<double> rateChange{1.0}; ///< h(0), h(1), …
    std::vector<double> step;            ///< q(0), q(1), … of a random walk; empty: no walk
    Rounding rounding = Rounding::HalfDown;

    /// One way to move: from a rate to a rate (indices 0 … rateCount-1) by whole cells, with ln probability.
    struct Move {
        int fromRate;
        int toRate;
        int cells;
        double lnProbability;
    };

    /// All moves, ordered by target rate, then source rate, then decreasing displacement, so that among equals the
    /// lowest rate, then the lowest source cell comes first.
    std::vector<Move> moves() const;

    /// Largest displacement |p' - p| of any move.
    int largestDisplacement() const;

    /// Throws Error naming `where` if the laws are no probability laws or the sizes make no sense.
    void check(const std::string &where) const;

    bool operator==(const KinematicAxis &) const = default;
};

} // namespace faintline
