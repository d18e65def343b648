#include "noise/pings/PingNoise.h"

namespace faintline {

const std::vector<Field<PingNoiseSettings>> &PingNoiseSettings::fields()
{
    using S = PingNoiseSettings;
    static const std::vector<Field<S>> table{
        field(&S::values, "values", pingValuesNames,
              "What the numbers of recorded pings are; auto: as their grid file says, otherwise guessed from their "
              "distribution. All but normalised are divided by the noise of their range and bearing.")
            .labelled("Numbers are")
            .advised("Set it if the guess is wrong: with powers taken for amplitudes, or the reverse, the calibration "
                     "does not hold."),
        field(&S::rangeCells, "rangeCells", "cells", 1.0, 10000.0,
              "Range cells on each side, beyond the guard cells, from which the noise of a cell of recorded pings is "
              "estimated.")
            .labelled("Noise half width")
            .advised("Raise it for a steadier estimate; lower it where reverberation changes quickly with range."),
        field(&S::guardCells, "guardCells", "cells", 0.0, 1000.0,
              "Range cells on each side of a cell that do not count for its own noise: as far as an echo extends.")
            .labelled("Guard cells")
            .advised("Raise it if an echo extends over more cells and is therefore taken for its own noise. The noise "
                     "is then estimated farther away."),
        field(&S::blockPings, "blockPings", "pings", 1.0, 100000.0,
              "Pings from which one noise background is estimated; between blocks it is interpolated.")
            .labelled("Block length")
            .advanced()
            .advised("Raise it for a steadier estimate; lower it if the background changes sooner. A target that stays "
                     "in its cell for half of a block is taken for noise."),
        field(&S::followPing, "followPing",
              "Divide out level changes of whole pings, such as those of the transmitted level or of a gain.")
            .labelled("Follow level of pings")
            .advanced()
            .advised("Switch it off if a ping's level is constant: the estimate of its level then adds no scatter."),
        field(&S::pastOnly, "pastOnly", "Estimate the noise of recorded pings from the previous block alone.")
            .labelled("Past pings only")
            .advanced()
            .advised("Switch it on to see what a system at sea would have known. The background then follows changes "
                     "one block later."),
    };
    return table;
}

} // namespace faintline
