#include "detect/PofN.h"

#include "base/Error.h"
#include "base/multiversion.h"

#include <algorithm>

namespace faintline {

namespace {

    FAINTLINE_MULTIVERSION
    void raise(float *to, const float *from, Index n)
    {
        for (Index i = 0; i < n; ++i)
            to[i] = from[i] > to[i] ? from[i] : to[i];
    }

    /// One insertion into a descending order: `rank` keeps the larger, `rest` goes on with the smaller.
    FAINTLINE_MULTIVERSION
    void insert(float *rank, float *rest, Index n)
    {
        for (Index i = 0; i < n; ++i) {
            const float larger = rest[i] > rank[i] ? rest[i] : rank[i];
            const float smaller = rest[i] > rank[i] ? rank[i] : rest[i];
            rank[i] = larger;
            rest[i] = smaller;
        }
    }

    FAINTLINE_MULTIVERSION
    void decide(const float *sum, const float *smallest, float r1, float r2, float oneOverP, Index n, float *statistic)
    {
        for (Index i = 0; i < n; ++i) {
            const float mean = sum[i] * oneOverP;
            statistic[i] = (smallest[i] > r1) & (mean > r2) ? mean : 0.0f;
        }
    }

} // namespace

const std::vector<Field<PofNSettings>> &PofNSettings::fields()
{
    using S = PofNSettings;
    static const std::vector<Field<S>> table{
        field(&S::p, "p", "frames", 1.0, 64.0, "Frames that must have an event."),
        field(&S::n, "n", "frames", 1.0, 64.0, "Frames in the window."),
        field(&S::r1, "r1", "", 0.0, 1e6, "A frame has an event where the largest y in the band exceeds this; noise has mean 1."),
        field(&S::r2, "r2", "", 0.0, 1e6, "Second threshold, on the mean of the P largest; 0: none."),
        field(&S::widthCells, "widthCells", "cells", 0.0, 1000.0, "Bandwidth of the window in resolution cells."),
    };
    return table;
}

PofN::PofN(const Grid &grid, const PofNSettings &settings, double binsPerCell)
    : m_rowLength(grid.axes.back().count), m_width(std::max<Index>(1, static_cast<Index>(std::lround(settings.widthCells * binsPerCell)))),
      m_settings(settings)
{
    if (settings.p > settings.n)
        throw Error("pOfN.p = " + std::to_string(settings.p), "must not exceed pOfN.n = " + std::to_string(settings.n));
    const auto cells = static_cast<std::size_t>(grid.size());
    m_maxima.assign(static_cast<std::size_t>(settings.n), std::vector<float>(cells, 0.0f));
    m_largest.resize(cells * static_cast<std::size_t>(settings.p));
}

void PofN::update(std::span<const float> y, std::span<float> statistic)
{
    const auto cells = static_cast<Index>(y.size());
    std::vector<float> &newest = m_maxima[m_next];
    m_next = (m_next + 1) % m_maxima.size();
    std::copy(y.begin(), y.end(), newest.begin());
    for (Index shift = -(m_width - 1) / 2; shift <= m_width / 2; ++shift) {
        const Index overlap = m_rowLength - std::abs(shift);
        if (shift != 0 && overlap > 0)
            for (Index row = 0; row < cells; row += m_rowLength)
                raise(newest.data() + row + std::max<Index>(0, -shift), y.data() + row + std::max<Index>(0, shift), overlap);
    }

    std::fill(m_largest.begin(), m_largest.end(), 0.0f);
    const auto rank = [&](int i) { return m_largest.data() + i * cells; };
    for (const std::vector<float> &maxima : m_maxima) {
        std::copy(maxima.begin(), maxima.end(), statistic.begin());
        for (int i = 0; i < m_settings.p; ++i)
            insert(rank(i), statistic.data(), cells);
    }
    // In ascending order of rank, so that the sum's rounding does not depend on where the window's frames stand in memory.
    std::fill(statistic.begin(), statistic.end(), 0.0f);
    for (int i = m_settings.p - 1; i >= 0; --i)
        std::transform(statistic.begin(), statistic.end(), rank(i), statistic.begin(), std::plus<>());
    decide(statistic.data(), rank(m_settings.p - 1), static_cast<float>(m_settings.r1), static_cast<float>(m_settings.r2),
           1.0f / static_cast<float>(m_settings.p), cells, statistic.data());
}

void PofN::forget(const Grid &grid, const CellBox &box)
{
    box.forEachCell(grid, [&](Index cell) {
        for (std::vector<float> &maxima : m_maxima)
            maxima[static_cast<std::size_t>(cell)] = 0.0f;
    });
}

} // namespace faintline
