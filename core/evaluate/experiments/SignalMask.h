#pragma once

#include "base/Axis.h"

#include <span>
#include <utility>
#include <vector>

namespace faintline {

/// Cells of a recording that hold signals: ranges of bins, frame by frame.
class SignalMask
{
public:
    SignalMask(Index frames, Index bins);

    /// Adds bins low … high of a frame, clipped at the band's edges; frames outside the recording are ignored.
    void add(Index frame, Index low, Index high);

    /// Whether any of the bins low … high holds a signal in that frame.
    bool touches(Index frame, Index low, Index high) const;

    /// Sets y = 0 where there is a signal, in a row that begins with `firstBin`.
    void blank(Index frame, Index firstBin, std::span<float> y) const;

    /// Fraction of all frames × bins without signals.
    double freeShare() const;

private:
    Index m_bins;
    std::vector<std::vector<std::pair<Index, Index>>> m_stretches; ///< for each frame, ascending, disjoint
};

} // namespace faintline
