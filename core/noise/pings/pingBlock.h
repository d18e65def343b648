#pragma once

#include "base/Grid.h"
#include "noise/pings/PingNoise.h"

#include <span>
#include <vector>

namespace faintline {

// Noise estimate from one block of pings.

/// Cells of a ping as beams, each a sequence of range cells. Range is the axis of that name, otherwise the first one; a
/// beam is one combination of cells of all other axes.
class BeamLayout
{
public:
    explicit BeamLayout(const Grid &grid);

    Index ranges() const { return m_ranges; }
    Index beams() const { return m_beams; }
    Index cells() const { return m_ranges * m_beams; }
    Index cell(Index beam, Index range) const
    {
        return (beam / m_stride * m_ranges + range) * m_stride + beam % m_stride;
    }

private:
    Index m_ranges;
    Index m_beams;
    Index m_stride; ///< between neighbouring range cells
};

/// ln power of a cell without noise: fewer than half of its values are above 0.
inline constexpr float noPingNoise = -200.0f;

/// Divides pings (pings × cells) that are clearly louder or softer than `lnNoise` by their level; whether there are
/// any.
bool levelPings(std::span<float> pings, std::span<const float> lnNoise);

/// ln mean noise power of each cell from a block of pings (pings × cells); NaN is not observed. The order of `pings`
/// is kept, but loud and soft ones are levelled.
///
///   c(r, b) = ln of the median over pings, without its bias
///   B₀ = s(r) + g(b) + running median of (c - s - g) along range, s(r): median over beams of c - g
///   B = B₀ + ln μ(r, b)
///
/// g is the gain of a beam, s the fall of reverberation that all beams share: without it a running median would be
/// biased where reverberation is steep. μ is the mean of p/e^B₀ over a split window: `rangeCells` range cells of the
/// same beam on each side, beyond `guardCells`, and all pings of the block. Values above 5 do not count, and the mean
/// of an exponential is found from the rest. Hence an echo does not raise its own noise, however long it stays, and
/// another one in the window counts for less than five cells of noise. Source of the split window: Struzinski and Lowe,
/// J. Acoust. Soc. Am. 76 (1984), 1738-1742.
std::vector<float> pingBlockNoise(std::vector<float> &pings, const BeamLayout &layout,
                                  const PingNoiseSettings &settings);

} // namespace faintline
