#pragma once

#include "detect/AxisStep.h"

#include <vector>

namespace faintline {

/// max(of(cell), other(cell - back)) of two rates or maxima, wanted at shifts smallest … largest.
struct SharedMaximum {
    Index number; ///< on from the rates: those over two rates, then those over four
    Index of;
    Index other;
    Index back;
    Index smallest;
    Index largest;
};

/// Maxima over two and four rates that the targets of one axis share.
struct SharedMaxima {
    /// Those to make before each target rate, in this order.
    std::vector<std::vector<SharedMaximum>> before;
    std::vector<Index> largest; ///< shift that each is wanted at
    Index ring = 0;             ///< rates whose maxima are kept at a time; 0: there are none

    /// Most cells beyond those of its tile that a maximum needs.
    Index longestSpan() const;
};

/// Replaces runs of sources of equal weight, each two rates and a cell on from the one before, by maxima over two and
/// four of them. They may overlap: a maximum minds no repetition. `keepsAll`: until all targets are finished.
template <class Real>
SharedMaxima shareMaxima(AxisStep<Real> &step, bool keepsAll);

} // namespace faintline
