#include "noise/FrameNormaliser.h"

#include "base/fastmath.h"
#include "base/multiversion.h"
#include "noise/constants.h"
#include "noise/levels.h"
#include "noise/medians.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace faintline {

namespace {

    constexpr float largestRatio = 1e30f;

    // Per-frame operations, cell by cell and bin by bin.

    inline float overPower(float y, float ln)
    {
        const float ratio = y * fastExp(-ln);
        const float most = ratio < largestRatio ? ratio : largestRatio;
        return ln <= 0.5f * NoiseBackground::silence ? 0.0f : most;
    }

    /// ln B of the bins, interpolated between cells: at a band's edge B falls by 20 dB between cells. `ln` has one value
    /// more than there are cells.
    FAINTLINE_MULTIVERSION
    void interpolateCells(const float *ln, double start, double perBin, double lastCell, std::span<float> atBins)
    {
        float *__restrict to = atBins.data();
        for (std::size_t bin = 0; bin < atBins.size(); ++bin) {
            double position = start + double(std::int32_t(bin)) * perBin;
            position = position > 0.0 ? position : 0.0;
            position = position < lastCell ? position : lastCell;
            const auto lower = std::int32_t(position);
            const auto fraction = float(position - double(lower));
            to[bin] = ln[lower] + fraction * (ln[lower + 1] - ln[lower]);
        }
    }

    /// The same for two bins a cell from the first one on. Their places are known, so that the compiler need not gather.
    FAINTLINE_MULTIVERSION
    void interpolateHalfCells(const float *ln, std::span<float> atBins)
    {
        float *__restrict to = atBins.data();
        const std::size_t pairs = atBins.size() / 2;
        for (std::size_t cell = 0; cell < pairs; ++cell) {
            to[2 * cell] = ln[cell];
            to[2 * cell + 1] = ln[cell] + 0.5f * (ln[cell + 1] - ln[cell]);
        }
        if (2 * pairs < atBins.size())
            to[2 * pairs] = ln[pairs];
    }

    /// y ← y/B
    FAINTLINE_MULTIVERSION
    void divideBinByBin(std::span<float> y, const float *ln)
    {
        for (std::size_t bin = 0; bin < y.size(); ++bin)
            y[bin] = overPower(y[bin], ln[bin]);
    }

    FAINTLINE_MULTIVERSION
    Index countAbove(const float *values, Index count, float limit)
    {
        std::int32_t above = 0;
        for (Index i = 0; i < count; ++i)
            above += values[i] > limit ? 1 : 0;
        return above;
    }

    void guardAgainstClicks(double binsPerCell, std::span<float> values)
    {
        // Handles changes shorter than the spacing of the levels. For most frames counting suffices: the median of a
        // sub-band exceeds a limit if more than half of its values do.
        const auto bands = std::size_t(NoiseBackground::subBandCount(double(values.size()) / binsPerCell));
        const double allowed = 1.0 + 4.0 * inverseLn2 / std::sqrt(2.0 * clickHalfWidthCells + 1.0);
        const auto limit = float(allowed * std::numbers::ln2_v<double>);
        bool isLoud = false;
        for (std::size_t band = 0; band < bands; ++band) {
            const auto from = std::ptrdiff_t(band * values.size() / bands);
            const auto to = std::ptrdiff_t((band + 1) * values.size() / bands);
            isLoud = isLoud || 2 * countAbove(values.data() + from, to - from, limit) > to - from;
        }
        if (!isLoud)
            return;
        // The frame's own running median over frequency, which preserves the edges of loud regions.
        const auto stride = std::size_t(std::max(1.0, std::floor(binsPerCell)));
        std::vector<float> ln;
        for (std::size_t bin = 0; bin < values.size(); bin += stride)
            ln.push_back(std::log(std::max(values[bin], 1e-6f)));
        const std::vector<float> medians = runningMedian(ln, clickHalfWidthCells);
        for (std::size_t bin = 0; bin < values.size(); ++bin) {
            const float excess = std::exp(medians[bin / stride]) / limit;
            if (excess > 1.0f)
                values[bin] /= excess;
        }
    }

} // namespace

void FrameNormaliser::normalise(std::span<float> values, const NoiseBackground &b, double seconds)
{
    const auto cells = std::size_t(b.frequency.count);
    m_ln.resize(cells + 1);
    b.readLnPower(seconds, std::span(m_ln).first(cells));
    m_ln[cells] = m_ln[cells - 1];
    const Axis &axis = m_spectrogram.frequency();
    const double start = b.frequency.position(axis.first);
    const double perBin = axis.step / b.frequency.step;
    if (start == 0.0 && perBin == 1.0 && values.size() <= cells) {
        divideBinByBin(values, m_ln.data());
    } else { // in two loops, each of which the compiler vectorises
        m_lnOfBins.resize(values.size());
        if (start == 0.0 && perBin == 0.5 && values.size() <= 2 * cells)
            interpolateHalfCells(m_ln.data(), m_lnOfBins);
        else
            interpolateCells(m_ln.data(), start, perBin, double(b.frequency.count - 1), m_lnOfBins);
        divideBinByBin(values, m_lnOfBins.data());
    }
    if (!b.lnAtEdges.empty() && b.bins == axis)
        divideBinByBin(values, b.lnAtEdges.data());
    if (m_guardsAgainstClicks)
        guardAgainstClicks(m_spectrogram.binsPerCell(), values);
}

} // namespace faintline
