#pragma once

#include <cstddef>
#include <vector>

namespace faintline {

/// A possible pair, with its cost.
struct PairCost {
    std::size_t from;
    std::size_t to;
    double cost;
};

/// Minimal-cost assignment with the option of assigning nothing: each `from` gets at most one `to`, and vice versa, so
/// that
///
///   Σ cost of the pairs + unassigned · (number of `from` without a pair)
///
/// is minimal. Returns the indices of the chosen pairs, ascending; pairs that cost `unassigned` or more are never
/// chosen. Each connected component is solved separately, by shortest augmenting paths (the Hungarian algorithm; Kuhn
/// 1955, Munkres 1957), O(n³) in its size. Oracle: enumeration of all assignments.
std::vector<std::size_t> assign(const std::vector<PairCost> &pairs, double unassigned);

} // namespace faintline
