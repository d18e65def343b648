#pragma once

#include "base/RunContext.h"
#include "noise/pings/PingNoise.h"
#include "noise/pings/PingPower.h"

#include <span>
#include <vector>

namespace faintline {

/// Mean noise power of each cell of recorded pings, block by block (pingBlockNoise).
///
/// The pings are divided into blocks of at least `blockPings`; the background of a ping is interpolated between the
/// centres of blocks, in the logarithm, and constant beyond the outer ones. From past pings alone (`pastOnly`), it is
/// that of the previous block, and in the first block its own.
class PingBackground
{
public:
    /// Reads at most 2²⁴ values, but at least 16 pings, of each block. Memory: 64 MiB, and that of the values. Throws
    /// Error if most cells hold no power, or if there are more than 2²⁰ cells; Cancelled.
    PingBackground(const PingPower &power, const PingNoiseSettings &settings, const RunContext &context = {});

    /// ln mean noise power of all cells of a ping; below `noPingNoise`/2 where there is no noise.
    void readLn(Index ping, std::span<float> ln) const;

    Index blockCount() const { return m_blocks; }

private:
    std::span<const float> block(Index index) const;

    Index m_cells;
    Index m_blocks = 1;
    double m_blockPings = 1.0;
    bool m_pastOnly;
    std::vector<float> m_ln; ///< blocks × cells
};

} // namespace faintline
