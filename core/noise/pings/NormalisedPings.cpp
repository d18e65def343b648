#include "noise/pings/NormalisedPings.h"

#include "noise/pings/pingBlock.h"

#include <cmath>
#include <limits>
#include <vector>

namespace faintline {

NormalisedPings::NormalisedPings(std::shared_ptr<const RawPings> pings, PingValues values, bool isGuessed,
                                 const PingNoiseSettings &settings, const RunContext &context)
    : NormalisedFrames(pings->info().time, pings->info().grid), m_power(std::move(pings), values), m_values(values),
      m_isGuessed(isGuessed), m_followsPing(settings.followPing), m_background(m_power, settings, context)
{
}

void NormalisedPings::read(Index first, Index count, std::span<float> out) const
{
    m_power.read(first, count, out);
    const auto cells = std::size_t(grid().size());
    std::vector<float> ln(cells);
    const std::vector<float> one(cells, 0.0f);
    for (Index i = 0; i < count; ++i) {
        const std::span<float> ping = out.subspan(std::size_t(i) * cells, cells);
        m_background.readLn(first + i, ln);
        for (std::size_t cell = 0; cell < cells; ++cell)
            ping[cell] = ln[cell] > 0.5f * noPingNoise ? ping[cell] * std::exp(-ln[cell])
                                                       : std::numeric_limits<float>::quiet_NaN();
        if (m_followsPing)
            levelPings(ping, one);
    }
}

std::string NormalisedPings::assumption() const
{
    const PingsInfo &info = m_power.pings().info();
    const std::string kind = info.isComplex ? "I/Q" : std::string(pingValuesNames[std::size_t(m_values)]);
    return info.sampleType + (m_isGuessed ? ", taken as " + kind + " from its distribution" : ", " + kind)
           + "; divided by its noise over range and bearing"
           + (m_isGuessed ? " (pings.values sets what the numbers are)" : "");
}

std::string pingAssumption(const NormalisedFrames &frames)
{
    return frames.assumption();
}

std::string pingGuess(const NormalisedFrames &frames)
{
    return frames.isGuessed() ? frames.assumption() : std::string();
}

} // namespace faintline
