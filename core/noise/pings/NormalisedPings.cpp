#include "noise/pings/NormalisedPings.h"

#include "base/Error.h"
#include "base/logmath.h"
#include "base/memoryShares.h"
#include "noise/dither.h"
#include "noise/pings/pingBlock.h"

#include <algorithm>
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

namespace {

    constexpr Index pingCellLimit = Index(1) << 20;
    constexpr Index mostValues = Index(1) << 24; ///< of a block
    constexpr Index fewestPings = 16;

    void checkHasNoise(const std::vector<float> &ln, const std::string &path)
    {
        const auto dead = std::count_if(ln.begin(), ln.end(), [](float value) { return value < 0.5f * noPingNoise; });
        if (2 * dead >= std::ssize(ln))
            throw Error(path, "holds no power in most of its cells: their values are 0, negative or not finite");
    }

} // namespace

PingBackground::PingBackground(const PingPower &power, const PingNoiseSettings &settings, const RunContext &context)
    : m_cells(power.grid().size()), m_pastOnly(settings.pastOnly)
{
    const std::string &path = power.pings().info().path;
    if (m_cells > pingCellLimit)
        throw Error(path, "has " + std::to_string(m_cells) + " cells in each ping; at most "
                              + std::to_string(pingCellLimit) + " can be normalised");
    const Index pings = power.time().count;
    const auto mostBlocks = std::max<Index>(1, Index(memoryShares::background / sizeof(float)) / m_cells);
    const Index wanted = std::max(Index(settings.blockPings), (pings + mostBlocks - 1) / mostBlocks);
    m_blocks = std::max<Index>(1, pings / wanted);
    m_blockPings = double(pings) / double(m_blocks);
    const double stride = std::max(1.0, m_blockPings / double(std::max(fewestPings, mostValues / m_cells)));

    const BeamLayout layout(power.grid());
    std::vector<float> values;
    for (Index b = 0; b < m_blocks; ++b) {
        context.checkpoint(double(b) / double(m_blocks), "noise background");
        values.clear();
        const double end = std::min(double(b + 1) * m_blockPings, double(pings));
        for (double ping = std::ceil(double(b) * m_blockPings); ping < end; ping += stride) {
            const std::size_t before = values.size();
            values.resize(before + std::size_t(m_cells));
            power.read(Index(ping), 1, std::span(values).subspan(before));
        }
        const std::vector<float> ln = pingBlockNoise(values, layout, settings);
        m_ln.insert(m_ln.end(), ln.begin(), ln.end());
    }
    checkHasNoise(m_ln, path);
}

std::span<const float> PingBackground::block(Index index) const
{
    return std::span(m_ln).subspan(std::size_t(index * m_cells), std::size_t(m_cells));
}

void PingBackground::readLn(Index ping, std::span<float> ln) const
{
    const double place = (double(ping) + 0.5) / m_blockPings;
    if (m_pastOnly) {
        const auto own = std::min(Index(place), m_blocks - 1);
        std::ranges::copy(block(std::max<Index>(0, own - 1)), ln.begin());
        return;
    }
    const double centred = std::clamp(place - 0.5, 0.0, double(m_blocks - 1));
    const auto lower = std::min(Index(centred), m_blocks - 1);
    const std::span<const float> before = block(lower);
    const std::span<const float> after = block(std::min(lower + 1, m_blocks - 1));
    const auto share = float(centred - double(lower));
    for (std::size_t cell = 0; cell < ln.size(); ++cell) {
        const bool areBoth = std::min(before[cell], after[cell]) > 0.5f * noPingNoise;
        ln[cell] = areBoth ? before[cell] + share * (after[cell] - before[cell]) : std::max(before[cell], after[cell]);
    }
}

PingPower::PingPower(std::shared_ptr<const RawPings> pings, PingValues values)
    : m_pings(std::move(pings)), m_values(values)
{
    std::vector<double> some;
    for (Index i = 0; i < std::min<Index>(m_pings->info().time.count, 8); ++i)
        for (const double power : powers(i, 1))
            if (power > 0.0)
                some.push_back(power);
    if (some.empty())
        return;
    const auto middle = some.begin() + std::ssize(some) / 2;
    std::nth_element(some.begin(), middle, some.end());
    m_unit = *middle;
}

double PingPower::powerOf(double value) const
{
    switch (m_values) {
    case PingValues::Magnitude:
        return value * value;
    case PingValues::Decibels:
        return ratioFromDb(value);
    case PingValues::Automatic:
    case PingValues::Normalised:
    case PingValues::Power:
        break;
    }
    return std::max(value, 0.0);
}

std::vector<double> PingPower::powers(Index first, Index count) const
{
    const PingsInfo &info = m_pings->info();
    const auto parts = std::size_t(info.isComplex ? 2 : 1);
    const auto cells = std::size_t(count * m_pings->cells());
    std::vector<double> values(parts * cells);
    m_pings->read(first, count, values);
    if (info.quantum > 0.0) {
        const std::uint64_t before = std::uint64_t(first) * std::uint64_t(m_pings->cells()) * parts;
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] += info.quantum * (double(uniformAt(before + i)) - 0.5);
    }
    std::vector<double> power(cells);
    for (std::size_t i = 0; i < cells; ++i) {
        const double p =
            info.isComplex ? values[2 * i] * values[2 * i] + values[2 * i + 1] * values[2 * i + 1] : powerOf(values[i]);
        power[i] = std::isfinite(p) ? p : std::numeric_limits<double>::quiet_NaN();
    }
    return power;
}

void PingPower::read(Index first, Index count, std::span<float> out) const
{
    const std::vector<double> power = powers(first, count);
    std::transform(power.begin(), power.end(), out.begin(), [this](double p) { return float(p / m_unit); });
}

} // namespace faintline
