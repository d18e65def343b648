#pragma once

#include "frames/NormalisedFrames.h"
#include "frames/Spectrogram.h"
#include "noise/NoiseBackground.h"

#include <memory>
#include <span>
#include <vector>

namespace faintline {

/// A spectrogram over its noise background: y(t, f) = |S(t, f)|² / B(t, f), mean 1 on noise; 0 in digital silence, NaN
/// in gaps and stop bands.
class NormalisedSpectrogram final : public NormalisedFrames
{
public:
    NormalisedSpectrogram(std::shared_ptr<const Spectrogram> spectrogram,
                          std::shared_ptr<const NoiseBackground> background, const NormaliserSettings &settings);

    void read(Index first, Index count, std::span<float> out) const override;

    const Spectrogram *spectrogram() const override { return m_spectrogram.get(); }
    const NoiseBackground &background() const { return *m_background; }

private:
    std::shared_ptr<const Spectrogram> m_spectrogram;
    std::shared_ptr<const NoiseBackground> m_background;
    NormaliserSettings m_settings;
};

} // namespace faintline
