#pragma once

#include "recursion/AxisStep.h"

#include <vector>

namespace faintline {

/// max(of(cell), other(cell - back)) of two rates or maxima, needed at shifts smallest … largest.
struct SharedMaximum {
    Index number; ///< numbered after the rates: first maxima over two rates, then over four
    Index of;
    Index other;
    Index back;
    Index smallest;
    Index largest;
};

/// Maxima over two and four rates, shared by the targets of one axis.
struct SharedMaxima {
    /// The maxima to compute before each target rate, in this order.
    std::vector<std::vector<SharedMaximum>> before;
    std::vector<Index> largest; ///< largest shift at which each is needed
    Index ring = 0;             ///< number of rates whose maxima are kept at a time; 0: no maxima

    /// Largest number of cells beyond its tile that a maximum needs.
    Index longestSpan() const;
};

/// Replaces runs of sources of equal weight, each two rates and a cell after the previous one, by maxima over two and
/// four of them. They may overlap, because repetition does not change a maximum. `keepsAll`: keeps the maxima until all
/// targets are finished.
template <class Real>
SharedMaxima shareMaxima(AxisStep<Real> &step, bool keepsAll);

} // namespace faintline
