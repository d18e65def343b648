#include "noise/NoiseNormaliser.h"

#include "frames/observed.h"
#include "noise/FrameNormaliser.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

NormalisedSpectrogram::NormalisedSpectrogram(std::shared_ptr<const Spectrogram> spectrogram,
                                             std::shared_ptr<const NoiseBackground> background,
                                             const NormaliserSettings &settings)
    : NormalisedFrames(spectrogram->time(), Grid{{spectrogram->frequency()}}), m_spectrogram(std::move(spectrogram)),
      m_background(std::move(background)), m_settings(settings)
{
}

namespace {

    /// Leaves the bins of a stop band out of a frame.
    void blank(const StopBand &band, const Axis &frequency, std::span<float> values)
    {
        const auto binAt = [&](double hz) {
            return std::clamp<Index>(Index(std::ceil(frequency.position(hz))), 0, frequency.count);
        };
        const auto begin = values.begin();
        std::fill(begin + binAt(band.lowHz), begin + binAt(band.highHz), std::numeric_limits<float>::quiet_NaN());
    }

} // namespace

void NormalisedSpectrogram::read(Index first, Index count, std::span<float> out) const
{
    m_spectrogram->read(first, count, out);
    const auto cells = std::size_t(grid().size());
    FrameNormaliser normaliser(*m_spectrogram, m_settings.followLevel);
    for (Index i = 0; i < count; ++i) {
        const std::span<float> values = out.subspan(std::size_t(i) * cells, cells);
        if (isObserved(*m_spectrogram, first + i)) {
            normaliser.normalise(values, *m_background, time().value(double(first + i)));
            for (const StopBand &band : m_background->stopBands)
                blank(band, grid().axes.front(), values);
        } else {
            std::fill(values.begin(), values.end(), std::numeric_limits<float>::quiet_NaN());
        }
    }
}

} // namespace faintline
