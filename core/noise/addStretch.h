#pragma once

#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

#include <vector>

namespace faintline {

/// Frames of a stretch of time, as the detector sees them: windows from `first` on, each shifted by `shift` hops.
struct StretchFrames {
    Index first;
    Index count;
    Index steps;
    const Spectrogram &windows;
    const std::vector<Spectrogram> &shifted;

    std::vector<float> read(Index shift, Index cells) const
    {
        const Spectrogram &source = shift == 0 ? windows : shifted[std::size_t(shift - 1)];
        const Index there = std::max<Index>(0, std::min(count, source.time().count - first));
        std::vector<float> frames(std::size_t(there * cells));
        if (there > 0)
            source.read(first, there, frames);
        return frames;
    }
};

/// If a stretch's noise is a sum of sources, adds them to the background and replaces its levels by levels over them.
void addStretch(NoiseBackground &background, const StretchFrames &stretchFrames, Index half, double likeness,
                std::vector<float> &levels);

} // namespace faintline
