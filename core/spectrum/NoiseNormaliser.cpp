#include "spectrum/NoiseNormaliser.h"

#include "spectrum/FrameNormaliser.h"

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
    FrameNormaliser normaliser(*m_spectrogram, m_settings.followLevel);
    for (Index i = 0; i < count; ++i)
        normaliser.normalise(out.subspan(std::size_t(i) * cells, cells), *m_background,
                             time().value(double(first + i)));
}

} // namespace faintline
