#include "detect/Integrator.h"

#include "base/multiversion.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// Replaces unobserved values by noise of mean 1.
    inline float observed(float y)
    {
        return y == y ? y : 1.0f;
    }

    FAINTLINE_MULTIVERSION
    void slide(double *sum, float *oldest, const float *y, double scale, std::span<float> statistic)
    {
        for (std::size_t i = 0; i < statistic.size(); ++i) {
            const float newest = observed(y[i]);
            sum[i] += double(newest) - double(oldest[i]);
            oldest[i] = newest;
            statistic[i] = float(sum[i] * scale);
        }
    }

    FAINTLINE_MULTIVERSION
    void fade(double *mean, const float *y, double decay, Index n, float *statistic)
    {
        for (Index i = 0; i < n; ++i) {
            mean[i] = (1.0 - decay) * double(observed(y[i])) + decay * mean[i];
            statistic[i] = float(mean[i]);
        }
    }

} // namespace

const std::vector<Field<IntegratorSettings>> &IntegratorSettings::fields()
{
    using S = IntegratorSettings;
    static const std::vector<Field<S>> table{
        field(&S::shape, "shape", S::shapeNames, "Sliding mean, or exponentially weighted mean.")
            .labelled("Shape")
            .advised("The sliding mean forgets a signal completely after its length; the exponential mean responds "
                     "sooner and forgets gradually."),
        field(&S::durationWindows, "durationWindows", "windows", 0.0, 1e5,
              "Length of the mean, or its time constant, in windows of the spectrogram.")
            .labelled("Duration")
            .advised("Lengthen it for steady lines: the SNR that is required falls by about 1.5 dB with each doubling. "
                     "A line that leaves its cell within this time is lost."),
    };
    return table;
}

Integrator::Integrator(Index cells, IntegratorSettings::Shape shape, Index frames)
    : m_frames(std::max<Index>(1, frames)), m_decay(std::exp(-1.0 / double(m_frames))), m_sum(std::size_t(cells), 0.0)
{
    if (shape == IntegratorSettings::Shape::Boxcar)
        m_past.assign(std::size_t(m_frames), std::vector<float>(std::size_t(cells), 0.0f));
}

void Integrator::update(std::span<const float> y, std::span<float> statistic)
{
    const auto cells = Index(y.size());
    if (m_past.empty()) {
        fade(m_sum.data(), y.data(), m_decay, cells, statistic.data());
        return;
    }
    slide(m_sum.data(), m_past[m_next].data(), y.data(), 1.0 / double(m_frames), statistic);
    m_next = (m_next + 1) % m_past.size();
}

void Integrator::forget(const Grid &grid, const CellBox &box)
{
    box.forEachCell(grid, [&](Index cell) {
        const auto i = std::size_t(cell);
        m_sum[i] = m_past.empty() ? 1.0 : double(m_past.size());
        for (std::vector<float> &frame : m_past)
            frame[i] = 1.0f;
    });
}

std::size_t Integrator::bytes() const
{
    std::size_t values = 0;
    for (const std::vector<float> &frame : m_past)
        values += frame.capacity();
    return sizeof *this + m_sum.capacity() * sizeof(double) + values * sizeof(float);
}

} // namespace faintline
