#include "noise/CausalBackground.h"

#include "noise/averageWhileSteady.h"
#include "noise/bandLevels.h"
#include "noise/constants.h"
#include "noise/levels.h"

#include <algorithm>

namespace faintline {

namespace {

    double scatterOf(const CausalGeometry &geometry, double cells)
    {
        return geometry.overlap * meanScatter(std::max(1.0, cells), geometry.likeness);
    }

    CausalLevels levelsFor(const CausalGeometry &geometry, Index bands)
    {
        const auto cells = double(geometry.cells);
        return {bands, scatterOf(geometry, cells), scatterOf(geometry, cells / double(std::max<Index>(1, bands)))};
    }

} // namespace

CausalBackground::CausalBackground(const CausalGeometry &geometry, const Axis &frequency,
                                   std::span<const float> firstBlock)
    : m_geometry(geometry), m_cells(frequency.count),
      m_bands(geometry.followsLevel ? NoiseBackground::subBandCount(double(frequency.count)) : 0),
      m_firstBlockWindows(std::ssize(firstBlock) / frequency.count), m_levels(levelsFor(geometry, m_bands))
{
    m_background.frequency = frequency;
    m_background.time = {"time", "s", 0.0, 1.0, 1, false}; // valid at any time
    m_background.levelTime = m_background.time;
    m_background.bandCount = m_bands;
    m_background.lnLevel.assign(std::size_t(m_bands), 0.0f);
    for (Index window = 0; window < m_firstBlockWindows; ++window)
        keepWindow(firstBlock.subspan(std::size_t(window * m_cells), std::size_t(m_cells)));
    renew();
}

void CausalBackground::keepWindow(std::span<const float> power)
{
    if (std::none_of(power.begin(), power.end(), [](float value) { return value > 0.0f; }))
        return; // digital silence carries no information
    if (std::ssize(m_windows) == m_geometry.blockWindows * m_cells) {
        std::move(m_windows.begin() + m_cells, m_windows.end(), m_windows.begin());
        m_windows.resize(m_windows.size() - std::size_t(m_cells));
    }
    m_windows.insert(m_windows.end(), power.begin(), power.end());
    ++m_sinceRenewal;
}

double CausalBackground::marginOf(std::size_t blocks) const
{
    const double cells = 2.0 * double(m_geometry.halfWidthCells) + 1.0;
    const auto windows = double(std::ssize(m_windows) / m_cells);
    const double variance =
        inverseLn2 * inverseLn2 * m_geometry.likeness / (std::max(1.0, windows) * cells * double(blocks));
    return 0.5 * alarmsPerExcess * variance;
}

void CausalBackground::renew()
{
    m_sinceRenewal = 0;
    std::vector<float> block = m_windows;
    BlockMedians typical(block, m_cells);
    if (m_bands > 0)
        flatten(block, m_cells, typical);
    m_blocks.push_back(blockBackground(typical, m_geometry.halfWidthCells));
    // Blocks this many renewals apart share no window.
    const auto apart =
        std::size_t((m_geometry.blockWindows + m_geometry.renewalWindows() - 1) / m_geometry.renewalWindows());
    if (m_blocks.size() > apart * std::size_t(steadyBlocks) + 1)
        m_blocks.pop_front();
    std::vector<float> medians;
    std::vector<float> rows;
    const std::size_t newest = m_blocks.size() - 1;
    for (std::size_t i = newest % apart; i <= newest; i += apart) {
        medians.insert(medians.end(), m_blocks[i].medians.begin(), m_blocks[i].medians.end());
        rows.insert(rows.end(), m_blocks[i].lnPower.begin(), m_blocks[i].lnPower.end());
    }
    BlockBackground colour = m_blocks.back();
    if (!m_windows.empty())
        colour.lnPower =
            averageOfLatest(medians, rows, m_cells, m_geometry.halfWidthCells, double(std::ssize(m_windows) / m_cells));
    const bool wasHeard = !m_colour.lnPower.empty() && m_colour.lnPower.front() > 0.5f * NoiseBackground::silence;
    if (m_bands > 0 && wasHeard)
        m_levels.moveBy(
            meanOver(m_colour.lnPower.data(), colour.lnPower.data(), colour.isNoise.begin(), m_cells, m_bands));
    m_colour = std::move(colour);
    if (m_bands > 0 && !m_windows.empty())
        m_levels.setOffsets({levelsOf(block, m_colour, m_bands, m_geometry.likeness), m_bands + 1});
    const auto margin = float(marginOf(newest / apart + 1));
    m_background.lnPower = m_colour.lnPower;
    for (float &ln : m_background.lnPower)
        ln += margin;
}

const NoiseBackground &CausalBackground::next(std::span<const float> power)
{
    const Index steps = m_geometry.stepsPerWindow;
    const bool isWindow = m_frame % steps == 0;
    if (isWindow && m_frame / steps >= m_firstBlockWindows) {
        keepWindow(power);
        if (m_sinceRenewal >= m_geometry.renewalWindows())
            renew();
    }
    if (m_bands > 0 && m_frame % m_geometry.levelFrames() == 0) {
        m_levels.push(levelsOf(power, m_colour, m_bands, m_geometry.likeness));
        m_background.lnLevel = m_levels.latest();
    }
    ++m_frame;
    return m_background;
}

std::size_t CausalBackground::bytes() const
{
    const auto cells = std::size_t(m_cells);
    return sizeof *this + m_windows.capacity() * sizeof(float) + (m_blocks.size() + 1) * cells * (2 * sizeof(float) + 1)
           + cells * sizeof(float) + m_levels.bytes();
}

namespace {

    constexpr Index smoothedFrames = 256; ///< frames that latestBeyondScatter uses

} // namespace

CausalLevels::CausalLevels(Index bands, double commonScatter, double bandScatter)
    : m_columns(bands + 1), m_commonScatter(commonScatter), m_bandScatter(bandScatter),
      m_levels(std::size_t(smoothedFrames * m_columns), 0.0f), m_offsets(std::size_t(m_columns), 0.0f)
{
}

void CausalLevels::push(std::span<const float> levels)
{
    if (rows() >= 2 * smoothedFrames) // moves memory only once per that many frames
        m_levels.erase(m_levels.begin(), m_levels.end() - smoothedFrames * m_columns);
    const bool isKnown = levels.back() < levelNotKnown;
    const std::size_t before = m_levels.size() - std::size_t(m_columns);
    for (std::size_t column = 0; column < levels.size(); ++column)
        m_levels.push_back(isKnown ? levels[column] : m_levels[before + column]);
}

void CausalLevels::moveBy(std::span<const double> rise)
{
    for (std::size_t i = 0; i < m_levels.size(); ++i)
        m_levels[i] += float(rise[i % rise.size()]);
}

void CausalLevels::setOffsets(const LevelOffsets &offsets)
{
    for (std::size_t column = 0; column < m_offsets.size(); ++column) {
        const bool isCommon = column + 1 == m_offsets.size();
        m_offsets[column] = offsets.isSure[column] ? offsets.medians[column]
                            : isCommon             ? 0.0f
                                                   : shareOfLines(offsets.medians[column]);
    }
}

/// Reads the last frames' values of a column, minus its offset.
void CausalLevels::readSeries(Index column, std::vector<float> &series) const
{
    series.resize(std::size_t(smoothedFrames));
    const Index first = rows() - smoothedFrames;
    for (Index i = 0; i < smoothedFrames; ++i)
        series[std::size_t(i)] =
            m_levels[std::size_t((first + i) * m_columns + column)] - m_offsets[std::size_t(column)];
}

std::vector<float> CausalLevels::latest() const
{
    std::vector<float> common;
    readSeries(m_columns - 1, common);
    const float commonLevel = latestBeyondScatter(common, m_commonScatter);
    std::vector<float> result;
    std::vector<float> own;
    for (Index band = 0; band + 1 < m_columns; ++band) {
        readSeries(band, own);
        for (std::size_t i = 0; i < own.size(); ++i)
            own[i] -= common[i];
        result.push_back(commonLevel + latestBeyondScatter(own, m_bandScatter));
    }
    return result;
}

} // namespace faintline
