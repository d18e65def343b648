#include "noise/CausalLevels.h"

#include "noise/levels.h"

namespace faintline {

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
