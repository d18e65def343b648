#pragma once

#include "base/Field.h"
#include "signal/RawPings.h"

#include <vector>

namespace faintline {

/// How recorded pings, frames on several axes that are not power over noise yet, are normalised (PingBackground).
struct PingNoiseSettings {
    PingValues values = PingValues::Automatic;
    int rangeCells = 20;    ///< on each side, beyond the guard cells, from which a cell's noise is estimated
    int guardCells = 3;     ///< on each side of a cell, without influence on its own noise
    int blockPings = 48;    ///< pings from which one background is estimated
    bool followPing = true; ///< divide out level changes of whole pings
    bool pastOnly = false;  ///< from the previous block alone, not from later pings

    static const std::vector<Field<PingNoiseSettings>> &fields();
    bool operator==(const PingNoiseSettings &) const = default;
};

} // namespace faintline
