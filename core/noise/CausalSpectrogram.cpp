#include "noise/CausalSpectrogram.h"

#include "base/memoryShares.h"
#include "noise/FrameNormaliser.h"
#include "noise/NoiseNormaliser.h"
#include "noise/coarseFrames.h"
#include "signal/endless.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace faintline {

namespace {

    constexpr Index checkpointFrames = 64; ///< initial interval
    constexpr Index mostBlockWindows = 512;

    Index blockWindowsOf(const NormaliserSettings &settings)
    {
        return std::clamp<Index>(std::llround(settings.blockWindows), 2, mostBlockWindows);
    }

    CausalGeometry geometryOf(const Spectrogram &coarse, const NormaliserSettings &settings)
    {
        const std::vector<float> window = sampleWindow(coarse.settings().window, coarse.windowSamples());
        CausalGeometry geometry;
        geometry.cells = coarse.frequency().count;
        geometry.stepsPerWindow = coarse.settings().stepsPerWindow;
        geometry.blockWindows = blockWindowsOf(settings);
        geometry.halfWidthCells = settings.halfWidthCells;
        geometry.followsLevel = settings.followLevel;
        geometry.likeness = cellLikeness(window);
        geometry.overlap = overlapFactor(window, std::min(coarse.settings().stepsPerWindow, 4));
        return geometry;
    }

} // namespace

CausalSpectrogram::CausalSpectrogram(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings)
    : NormalisedFrames(spectrogram->time(), Grid{{spectrogram->frequency()}}), m_spectrogram(std::move(spectrogram)),
      m_settings(settings), m_coarse(coarseFrames(*m_spectrogram, settings, m_spectrogram->settings().stepsPerWindow)),
      m_geometry(geometryOf(m_coarse, settings)), m_kept(checkpointFrames, memoryShares::background),
      m_keepsStates(m_spectrogram->recording().info().sampleCount < endlessSamples) // else nothing is read twice
{
    m_power.resize(std::size_t(m_geometry.cells));
    m_background = begin();
    m_firstBackground = std::make_shared<const NoiseBackground>(m_background->latest());
}

/// It stands nowhere yet.
CausalSpectrogram::CausalSpectrogram(std::shared_ptr<const Spectrogram> spectrogram, const CausalSpectrogram &like)
    : NormalisedFrames(spectrogram->time(), Grid{{spectrogram->frequency()}}), m_spectrogram(std::move(spectrogram)),
      m_settings(like.m_settings),
      m_coarse(coarseFrames(*m_spectrogram, m_settings, m_spectrogram->settings().stepsPerWindow)),
      m_geometry(like.m_geometry), m_firstBackground(like.m_firstBackground), m_next(std::numeric_limits<Index>::max()),
      m_keepsStates(true)
{
    m_power.resize(std::size_t(m_geometry.cells));
    const std::lock_guard lock(like.m_mutex);
    m_kept = like.m_kept;
}

void CausalSpectrogram::keepStates() const
{
    const std::lock_guard lock(m_mutex);
    m_keepsStates = true;
}

std::shared_ptr<const CausalSpectrogram> CausalSpectrogram::over(RecordingPointer recording) const
{
    auto same =
        std::make_shared<Spectrogram>(std::move(recording), m_spectrogram->settings(), m_spectrogram->selection());
    return std::shared_ptr<const CausalSpectrogram>(new CausalSpectrogram(std::move(same), *this));
}

Index CausalSpectrogram::samplesOfFirstBlock(const Spectrogram &spectrogram, const NormaliserSettings &settings)
{
    return (blockWindowsOf(settings) - 1) * spectrogram.settings().stepsPerWindow * spectrogram.hopSamples()
           + spectrogram.windowSamples();
}

CausalBackground CausalSpectrogram::begin() const
{
    const Index steps = m_geometry.stepsPerWindow;
    const Index windows = std::min(m_geometry.blockWindows, (m_coarse.time().count - 1) / steps + 1);
    std::vector<float> block(std::size_t(windows * m_geometry.cells));
    for (Index window = 0; window < windows; ++window)
        m_coarse.read(window * steps, 1,
                      std::span(block).subspan(std::size_t(window * m_geometry.cells), std::size_t(m_geometry.cells)));
    return {m_geometry, m_coarse.frequency(), block};
}

const NoiseBackground &CausalSpectrogram::step() const
{
    if (m_keepsStates && m_kept.lacks(m_next)) {
        auto state = std::make_shared<const CausalBackground>(*m_background);
        const std::size_t bytes = state->bytes();
        m_kept.keep(m_next, std::move(state), bytes);
    }
    m_coarse.read(m_next++, 1, m_power);
    return m_background->next(m_power);
}

void CausalSpectrogram::goTo(Index frame) const
{
    if (const Index kept = m_kept.latest(frame); m_next > frame || kept > m_next) {
        const auto state = m_kept.at(kept);
        m_background = state ? *state : begin();
        m_next = state ? kept : 0;
    }
    while (m_next < frame)
        step();
}

void CausalSpectrogram::read(Index first, Index count, std::span<float> out) const
{
    m_spectrogram->read(first, count, out);
    const auto cells = std::size_t(grid().size());
    FrameNormaliser normaliser(*m_spectrogram, m_settings.followLevel);
    const std::lock_guard lock(m_mutex);
    goTo(first);
    for (Index i = 0; i < count; ++i) {
        const NoiseBackground &background = step();
        const std::span<float> values = out.subspan(std::size_t(i) * cells, cells);
        normaliser.normalise(values, background, 0.0);
        if (!m_spectrogram->isObserved(first + i))
            std::fill(values.begin(), values.end(), std::numeric_limits<float>::quiet_NaN());
    }
}

NormalisedFramesPointer normalise(std::shared_ptr<const Spectrogram> spectrogram, const NormaliserSettings &settings,
                                  const RunContext &context)
{
    if (settings.causal)
        return std::make_shared<CausalSpectrogram>(std::move(spectrogram), settings);
    const auto background = estimateBackground(*spectrogram, settings, context);
    return std::make_shared<NormalisedSpectrogram>(std::move(spectrogram), background, settings);
}

} // namespace faintline
