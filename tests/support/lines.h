#pragma once

#include "scene/LineScene.h"

namespace faintline::test {

/// White noise without lines.
inline LineScene scene(double rateHz, double seconds, int seed)
{
    return {.sampleRateHz = rateHz, .durationSeconds = seconds, .seed = seed};
}

/// A line of constant power. `snrDb` is its SNR in a rectangular window of `referenceSeconds`.
inline LineSettings line(double hz, double driftHzPerSecond, double from, double seconds, double snrDb,
                         double referenceSeconds)
{
    return {.snrDb = snrDb,
            .referenceSeconds = referenceSeconds,
            .startSeconds = from,
            .durationSeconds = seconds,
            .frequencyHz = hz,
            .driftHzPerSecond = driftHzPerSecond};
}

/// Sweeps of 4 kHz/s for 0.4 s, of which a window of 16 ms sees most. The automatic one is 0.1 s.
inline LineScene sweeps()
{
    LineScene result = scene(8000.0, 10.0, 7);
    for (int i = 0; i < 8; ++i)
        result.lines.push_back(line(600.0 + 100.0 * i, 4000.0, 0.7 + 1.1 * i, 0.4, 22.0, 0.025));
    return result;
}

} // namespace faintline::test
