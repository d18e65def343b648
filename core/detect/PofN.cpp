#include "detect/PofN.h"

#include "base/Error.h"
#include "base/multiversion.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace faintline {

namespace {

    constexpr int maximumFrames = 64;

    FAINTLINE_MULTIVERSION
    void raise(float *to, const float *from, Index n)
    {
        for (Index i = 0; i < n; ++i)
            to[i] = from[i] > to[i] ? from[i] : to[i];
    }

    constexpr Index mostLanes = 16;

    /// The mean and the smallest of each cell's P largest, from the window's rows, oldest first; `n` is a multiple of
    /// the lanes. Only the shorter end is sorted: the P largest, or the N-P+1 smallest, the last of which is also the
    /// P-th largest.
    template <int bytes>
    [[gnu::always_inline]] inline void largestBy(std::span<const float *const> rows, int p, Index n, float *means,
                                                 float *smallest)
    {
        using Lanes = typename Vector<float, bytes>::Type;
        constexpr Index laneCount = Vector<float, bytes>::lanes;
        const int others = int(rows.size()) - p;
        const bool keepsLargest = p <= others + 1;
        const int ranks = keepsLargest ? p : others + 1;
        const float worst = keepsLargest ? 0.0f : std::numeric_limits<float>::infinity();
        const float oneOverP = 1.0f / float(p);
        Lanes rank[maximumFrames];
        for (Index i = 0; i < n; i += laneCount) {
            for (int r = 0; r < ranks; ++r)
                rank[r] = Lanes{} + worst;
            Lanes total{};
            for (const float *row : rows) {
                Lanes rest;
                std::memcpy(&rest, row + i, sizeof rest);
                total += rest;
                for (int r = 0; r < ranks; ++r) {
                    const Lanes kept = rank[r];
                    const auto better = keepsLargest ? rest > kept : rest < kept;
                    rank[r] = better ? rest : kept;
                    rest = better ? kept : rest;
                }
            }
            Lanes sum{};
            for (int r = ranks - 1; r >= 0; --r)
                if (keepsLargest || r + 1 < ranks)
                    sum += rank[r];
            const Lanes mean = (keepsLargest ? sum : total - sum) * oneOverP;
            std::memcpy(means + i, &mean, sizeof mean);
            std::memcpy(smallest + i, &rank[ranks - 1], sizeof mean);
        }
    }

    void largest(std::span<const float *const> rows, int p, Index n, float *means, float *smallest)
    {
        withVectors([&](auto bytes) __attribute__((always_inline)) { largestBy<bytes>(rows, p, n, means, smallest); });
    }

    FAINTLINE_MULTIVERSION
    void decide(const float *means, const float *smallest, float r1, float r2, std::span<float> statistic)
    {
        for (std::size_t i = 0; i < statistic.size(); ++i) {
            const float enough = smallest[i] > r1 ? means[i] : 0.0f;
            statistic[i] = means[i] > r2 ? enough : 0.0f;
        }
    }

} // namespace

const std::vector<Field<PofNSettings>> &PofNSettings::fields()
{
    using S = PofNSettings;
    static const std::vector<Field<S>> table{
        field(&S::p, "p", "frames", 1.0, maximumFrames, "Number of frames that must have an event.")
            .labelled("P, frames needed")
            .advised("Raise it against short bursts. Signals then have to last longer or be stronger."),
        field(&S::n, "n", "frames", 1.0, maximumFrames, "Number of frames in the window.")
            .labelled("N, frames in window")
            .advised("Lengthen it for intermittent signals. The decision comes later, and noise has more frames in "
                     "which to have events."),
        field(&S::r1, "r1", "", 0.0, 1e6,
              "A frame has an event if the largest y in the band exceeds this value; noise "
              "has mean 1.")
            .labelled("Event threshold r1")
            .advised("Lower it for weaker signals, and raise P to keep the number of false alarms. Exponential noise "
                     "exceeds r1 in a fraction e^-r1 of the cells."),
        field(&S::r2, "r2", "", 0.0, 1e6, "Second threshold, on the mean of the P largest, or \"none\".")
            .withWord(0.0, "none")
            .labelled("Mean threshold r2")
            .advanced()
            .advised("Raise it to require that events are strong as well as frequent."),
        field(&S::widthCells, "widthCells", "cells", 0.0, 1000.0, "Bandwidth of the window in resolution cells.")
            .labelled("Bandwidth")
            .advanced()
            .advised("Widen it for lines that drift or wander within the window of N frames. Noise then has more cells "
                     "in which to have events."),
    };
    return table;
}

PofN::PofN(const Grid &grid, const PofNSettings &settings, double binsPerCell)
    : m_rowLength(grid.axes.back().count),
      m_width(std::max<Index>(1, Index(std::lround(settings.widthCells * binsPerCell)))), m_settings(settings)
{
    if (settings.p > settings.n)
        throw fieldError("pOfN.p", std::to_string(settings.p),
                         "must not exceed pOfN.n = " + std::to_string(settings.n));
    m_means.resize(std::size_t((grid.size() + mostLanes - 1) / mostLanes * mostLanes));
    m_smallest.resize(m_means.size());
    m_maxima.assign(std::size_t(settings.n), std::vector<float>(m_means.size(), 0.0f));
}

void PofN::update(std::span<const float> y, std::span<float> statistic)
{
    const auto cells = Index(y.size());
    std::vector<float> &newest = m_maxima[m_next];
    m_next = (m_next + 1) % m_maxima.size();
    std::transform(y.begin(), y.end(), newest.begin(),
                   [](float value) { return value == value ? value : 0.0f; }); // not observed: no event
    for (Index shift = -(m_width - 1) / 2; shift <= m_width / 2; ++shift) {
        const Index overlap = m_rowLength - std::abs(shift);
        if (shift != 0 && overlap > 0)
            for (Index row = 0; row < cells; row += m_rowLength)
                raise(newest.data() + row + std::max<Index>(0, -shift), y.data() + row + std::max<Index>(0, shift),
                      overlap);
    }

    std::vector<const float *> rows; // from the oldest, so that rounding does not depend on memory positions
    for (std::size_t i = 0; i < m_maxima.size(); ++i)
        rows.push_back(m_maxima[(m_next + i) % m_maxima.size()].data());
    largest(rows, m_settings.p, std::ssize(m_means), m_means.data(), m_smallest.data());
    decide(m_means.data(), m_smallest.data(), float(m_settings.r1), float(m_settings.r2), statistic);
}

void PofN::forget(const Grid &grid, const CellBox &box)
{
    box.forEachCell(grid, [&](Index cell) {
        for (std::vector<float> &maxima : m_maxima)
            maxima[std::size_t(cell)] = 0.0f;
    });
}

std::size_t PofN::bytes() const
{
    std::size_t values = m_means.capacity() + m_smallest.capacity();
    for (const std::vector<float> &frame : m_maxima)
        values += frame.capacity();
    return sizeof *this + values * sizeof(float);
}

} // namespace faintline
