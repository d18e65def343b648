#include "spectrum/PingNoise.h"

namespace faintline {

const std::vector<Field<PingNoiseSettings>> &PingNoiseSettings::fields()
{
    using S = PingNoiseSettings;
    static const std::vector<Field<S>> table{
        field(&S::values, "values", pingValuesNames,
              "What the numbers of recorded pings are; auto: as their grid file says, otherwise guessed from their "
              "distribution. All but normalised are divided by the noise of their range and bearing."),
        field(&S::rangeCells, "rangeCells", "cells", 1.0, 10000.0,
              "Range cells on each side, beyond the guard cells, from which the noise of a cell of recorded pings is "
              "estimated."),
        field(&S::guardCells, "guardCells", "cells", 0.0, 1000.0,
              "Range cells on each side of a cell that do not count for its own noise: as far as an echo extends."),
        field(&S::blockPings, "blockPings", "pings", 1.0, 100000.0,
              "Pings from which one noise background is estimated; between blocks it is interpolated."),
        field(&S::followPing, "followPing",
              "Divide out level changes of whole pings, such as those of the transmitted level or of a gain."),
        field(&S::pastOnly, "pastOnly", "Estimate the noise of recorded pings from the previous block alone."),
    };
    return table;
}

} // namespace faintline
