#include "noise/NoiseNormaliser.h"

#include "noise/FrameNormaliser.h"
#include "noise/stopBands.h"

#include <algorithm>
#include <limits>

namespace faintline {

NormalisedSpectrogram::NormalisedSpectrogram(std::shared_ptr<const Spectrogram> spectrogram,
                                             std::shared_ptr<const NoiseBackground> background,
                                             const NormaliserSettings &settings)
    : NormalisedFrames(spectrogram->time(), Grid{{spectrogram->frequency()}}), m_spectrogram(std::move(spectrogram)),
      m_background(std::move(background)), m_settings(settings)
{
}

void NormalisedSpectrogram::read(Index first, Index count, std::span<float> out) const
{
    m_spectrogram->read(first, count, out);
    const auto cells = std::size_t(grid().size());
    constexpr float notObserved = std::numeric_limits<float>::quiet_NaN();
    FrameNormaliser normaliser(*m_spectrogram, m_settings.followLevel);
    for (Index i = 0; i < count; ++i) {
        const std::span<float> values = out.subspan(std::size_t(i) * cells, cells);
        if (!m_spectrogram->isObserved(first + i)) {
            std::ranges::fill(values, notObserved);
            continue;
        }
        normaliser.normalise(values, *m_background, time().value(double(first + i)));
        for (const StopBand &band : m_background->stopBands) {
            const auto [cell, end] = cellsIn(band, m_spectrogram->frequency());
            std::fill(values.begin() + cell, values.begin() + end, notObserved);
        }
    }
}

} // namespace faintline
