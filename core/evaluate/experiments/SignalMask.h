#pragma once

#include "base/Axis.h"

#include <span>
#include <utility>
#include <vector>

namespace faintline {

/// Where there are signals in a recording: stretches of bins, frame by frame.
class SignalMask
{
public:
    SignalMask(Index frames, Index bins);

    /// Bins low … high of a frame, cut off at the band's edges; frames outside of the recording are ignored.
    void add(Index frame, Index low, Index high);

    /// Whether any of the bins low … high has a signal in that frame.
    bool touches(Index frame, Index low, Index high) const;

    /// Sets y = 0 where there is a signal, in a row whose first value is that of `firstBin`.
    void blank(Index frame, Index firstBin, std::span<float> y) const;

    /// The share of all frames × bins that has none.
    double freeShare() const;

private:
    Index m_bins;
    std::vector<std::vector<std::pair<Index, Index>>> m_stretches; ///< of each frame, ascending, apart
};

} // namespace faintline
