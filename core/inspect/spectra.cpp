#include "inspect/spectra.h"

#include "analyse/preparePlan.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr Index spectrumFrames = 400;

    Index nearestFrame(const Axis &time, double seconds)
    {
        return std::clamp<Index>(Index(std::llround(time.position(seconds))), 0, time.count - 1);
    }

    /// Reads frames of an analysis in the unit of the quantity.
    class Reader
    {
    public:
        Reader(const Analysis &analysis, SpectrumQuantity quantity)
            : m_isDensity(quantity == SpectrumQuantity::Density && analysis.background),
              m_frames(m_isDensity ? analysis.lines.front() : framesOfLines(analysis)),
              m_values(std::size_t(axis().count))
        {
            if (!m_isDensity)
                return;
            const RecordingInfo &info = analysis.recording->info();
            m_unit = (info.isComplex ? 1.0 : 2.0) * std::exp(analysis.background->lnUnit) / info.sampleRateHz;
        }

        const Axis &axis() const { return m_frames->grid().axes.back(); }

        double value(std::size_t cell) const { return m_unit * double(m_values[cell]); }

        void read(Index frame, const RunContext &context)
        {
            if (m_isDensity)
                m_frames->readPower(frame, 1, m_values, context);
            else
                m_frames->read(frame, 1, m_values);
        }

    private:
        bool m_isDensity;
        NormalisedFramesPointer m_frames; ///< of single lines, also for a family; of a density, the first channel's
        double m_unit = 1.0;
        std::vector<float> m_values;
    };

} // namespace

Spectra spectraOf(const Analysis &analysis, double seconds, const TimeSpan &time, SpectrumQuantity quantity,
                  const RunContext &context)
{
    Reader reader(analysis, quantity);
    const Axis &axis = reader.axis();
    const auto cells = std::size_t(axis.count);
    Spectra spectra;
    std::vector<double> counts(cells, 0.0);
    spectra.mean.assign(cells, 0.0);
    const Index first = nearestFrame(analysis.time(), time.fromSeconds);
    const Index last = std::max(first, nearestFrame(analysis.time(), time.toSeconds));
    const Index frames = std::min(last - first + 1, spectrumFrames);
    for (Index i = 0; i < frames; ++i) {
        context.checkpoint(double(i) / double(frames), "averaging spectra");
        reader.read(frames == 1 ? first : first + i * (last - first) / (frames - 1), context);
        for (std::size_t cell = 0; cell < cells; ++cell)
            if (const double value = reader.value(cell); std::isfinite(value)) {
                spectra.mean[cell] += value;
                counts[cell] += 1.0;
            }
    }
    reader.read(nearestFrame(analysis.time(), seconds), context);
    for (std::size_t cell = 0; cell < cells; ++cell) {
        spectra.position.push_back(axis.value(double(cell)));
        spectra.frame.push_back(reader.value(cell));
        spectra.mean[cell] =
            counts[cell] > 0.0 ? spectra.mean[cell] / counts[cell] : std::numeric_limits<double>::quiet_NaN();
    }
    return spectra;
}

} // namespace faintline
