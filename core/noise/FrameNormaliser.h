#pragma once

#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

#include <span>
#include <vector>

namespace faintline {

/// Divides frames of a spectrogram by their noise.
///
/// values ← values/B, 0 in digital silence; ln B is interpolated between the background's cells. With
/// `guardsAgainstClicks`, a sub-band that lies mostly far above its background is divided by that excess. Holds scratch
/// memory: use one object per thread.
class FrameNormaliser
{
public:
    FrameNormaliser(const Spectrogram &spectrogram, bool guardsAgainstClicks)
        : m_spectrogram(spectrogram), m_guardsAgainstClicks(guardsAgainstClicks)
    {
    }

    /// Normalises one frame over the background at the time `seconds`.
    void normalise(std::span<float> values, const NoiseBackground &background, double seconds);

private:
    const Spectrogram &m_spectrogram;
    bool m_guardsAgainstClicks;
    std::vector<float> m_ln;
    std::vector<float> m_lnOfBins;
};

} // namespace faintline
