#include "noise/pings/pingBlock.h"

#include "noise/constants.h"
#include "noise/levels.h"
#include "noise/medians.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace faintline {

namespace {

    bool isNoise(float ln)
    {
        return ln > 0.5f * noPingNoise;
    }

    /// ln of the median over pings of each cell, without its bias for exponential values.
    std::vector<float> cellMedians(std::span<const float> pings, Index cells)
    {
        const Index count = std::ssize(pings) / cells;
        std::vector<float> ln(std::size_t(cells), noPingNoise);
        std::vector<float> column;
        for (Index cell = 0; cell < cells; ++cell) {
            column.clear();
            for (Index ping = 0; ping < count; ++ping)
                if (const float p = pings[std::size_t(ping * cells + cell)]; !std::isnan(p))
                    column.push_back(p);
            if (column.empty())
                continue;
            const double bias = medianMean(int(column.size()));
            if (const float median = medianOf(column); median > 0.0f)
                ln[std::size_t(cell)] = float(std::log(double(median) / bias));
        }
        return ln;
    }

    /// Median of the values that are noise; 0 if there are none.
    float noiseMedian(std::vector<float> values)
    {
        std::erase_if(values, [](float value) { return !isNoise(value); });
        return values.empty() ? 0.0f : medianOf(values);
    }

    /// Replaces cells without noise by their nearest neighbour with noise; false if there is none.
    bool fillGaps(std::vector<float> &line)
    {
        const auto first = std::find_if(line.begin(), line.end(), isNoise);
        if (first == line.end())
            return false;
        std::fill(line.begin(), first, *first);
        for (auto at = first + 1; at < line.end(); ++at)
            if (!isNoise(*at))
                *at = *(at - 1);
        return true;
    }

    /// g(b): median over ranges of c minus the median over beams.
    std::vector<float> beamGains(const std::vector<float> &ln, const BeamLayout &layout)
    {
        std::vector<float> middle;
        for (Index range = 0; range < layout.ranges(); ++range) {
            std::vector<float> row;
            for (Index beam = 0; beam < layout.beams(); ++beam)
                row.push_back(ln[std::size_t(layout.cell(beam, range))]);
            middle.push_back(noiseMedian(std::move(row)));
        }
        std::vector<float> gains;
        for (Index beam = 0; beam < layout.beams(); ++beam) {
            std::vector<float> line;
            for (Index range = 0; range < layout.ranges(); ++range)
                if (const float own = ln[std::size_t(layout.cell(beam, range))]; isNoise(own))
                    line.push_back(own - middle[std::size_t(range)]);
            gains.push_back(noiseMedian(std::move(line)));
        }
        return gains;
    }

    /// s(r): median over beams of c - g, and over as many ranges as it takes for enough values.
    std::vector<float> sharedShape(const std::vector<float> &ln, const std::vector<float> &gains,
                                   const BeamLayout &layout, double pings, Index most)
    {
        std::vector<float> shape;
        for (Index range = 0; range < layout.ranges(); ++range) {
            std::vector<float> row;
            for (Index beam = 0; beam < layout.beams(); ++beam)
                if (const float own = ln[std::size_t(layout.cell(beam, range))]; isNoise(own))
                    row.push_back(own - gains[std::size_t(beam)]);
            shape.push_back(row.empty() ? noPingNoise : medianOf(row));
        }
        if (!fillGaps(shape))
            return shape;
        const double wanted = 0.5 * (pingShapeValues / (pings * double(layout.beams())) - 1.0);
        const Index half = std::clamp(Index(std::ceil(wanted)), Index(1), std::max<Index>(1, most));
        return runningMedian(shape, half);
    }

    /// ln B₀ of all cells.
    std::vector<float> firstEstimate(const std::vector<float> &ln, const BeamLayout &layout, double pings,
                                     const PingNoiseSettings &settings)
    {
        const Index half = settings.rangeCells + settings.guardCells;
        const std::vector<float> gains = beamGains(ln, layout);
        const std::vector<float> shape = sharedShape(ln, gains, layout, pings, half);
        std::vector<float> estimate(ln.size(), noPingNoise);
        for (Index beam = 0; beam < layout.beams(); ++beam) {
            std::vector<float> rest;
            for (Index range = 0; range < layout.ranges(); ++range) {
                const float own = ln[std::size_t(layout.cell(beam, range))];
                rest.push_back(isNoise(own) ? own - gains[std::size_t(beam)] - shape[std::size_t(range)] : noPingNoise);
            }
            if (!fillGaps(rest))
                continue;
            const std::vector<float> smooth = runningMedian(rest, half);
            for (Index range = 0; range < layout.ranges(); ++range)
                if (const auto at = std::size_t(layout.cell(beam, range)); isNoise(ln[at]))
                    estimate[at] = gains[std::size_t(beam)] + shape[std::size_t(range)] + smooth[std::size_t(range)];
        }
        return estimate;
    }

    /// Number and sum of values below the cut, of one cell or up to one.
    struct Below {
        double sum = 0.0;
        double count = 0.0;
    };

    Below operator-(const Below &a, const Below &b)
    {
        return {a.sum - b.sum, a.count - b.count};
    }

    /// Mean of an exponential whose values below the cut have this mean: m = μ - c/(e^(c/μ) - 1).
    double exponentialMean(double mean)
    {
        double whole = mean;
        for (int pass = 0; pass < 12; ++pass)
            whole = std::min(double(lineLimit), mean + double(lineLimit) / std::expm1(double(lineLimit) / whole));
        return whole;
    }

    /// Adds ln μ to the cells of a beam. `upTo`: cumulative sums over its range cells.
    void refineBeam(std::span<float> estimate, const BeamLayout &layout, Index beam, const std::vector<Below> &upTo,
                    const PingNoiseSettings &settings)
    {
        const Index ranges = layout.ranges();
        for (Index range = 0; range < ranges; ++range) {
            const auto place = [&](Index at) { return std::size_t(std::clamp<Index>(at, 0, ranges)); };
            const Index inner = settings.guardCells;
            const Index outer = inner + settings.rangeCells;
            const Below window = upTo[place(range + outer + 1)] - upTo[place(range - outer)];
            const Below guarded = upTo[place(range + inner + 1)] - upTo[place(range - inner)];
            const Below used = window - guarded;
            float &own = estimate[std::size_t(layout.cell(beam, range))];
            if (isNoise(own) && used.count >= fewestRangeValues && used.sum > 0.0)
                own += float(std::log(exponentialMean(used.sum / used.count)));
        }
    }

    void refineEstimate(std::vector<float> &estimate, std::span<const float> pings, const BeamLayout &layout,
                        const PingNoiseSettings &settings)
    {
        const Index cells = layout.cells();
        std::vector<Below> below(estimate.size());
        for (Index first = 0; first < std::ssize(pings); first += cells)
            for (std::size_t cell = 0; cell < estimate.size(); ++cell) {
                if (!isNoise(estimate[cell]))
                    continue;
                const float ratio = pings[std::size_t(first) + cell] * std::exp(-estimate[cell]);
                if (ratio < lineLimit) { // not NaN
                    below[cell].sum += double(ratio);
                    below[cell].count += 1.0;
                }
            }
        std::vector<Below> upTo(std::size_t(layout.ranges()) + 1);
        for (Index beam = 0; beam < layout.beams(); ++beam) {
            for (Index range = 0; range < layout.ranges(); ++range) {
                const Below &own = below[std::size_t(layout.cell(beam, range))];
                const Below &before = upTo[std::size_t(range)];
                upTo[std::size_t(range) + 1] = {before.sum + own.sum, before.count + own.count};
            }
            refineBeam(estimate, layout, beam, upTo, settings);
        }
    }

} // namespace

BeamLayout::BeamLayout(const Grid &grid)
{
    const auto named =
        std::find_if(grid.axes.begin(), grid.axes.end(), [](const Axis &axis) { return axis.name == "range"; });
    const auto range = std::size_t(named == grid.axes.end() ? 0 : named - grid.axes.begin());
    m_ranges = grid.axes[range].count;
    m_beams = grid.size() / m_ranges;
    m_stride = grid.stride(range);
}

bool levelPings(std::span<float> pings, std::span<const float> lnNoise)
{
    constexpr Index mostCells = 65536;
    const auto cells = std::ssize(lnNoise);
    const Index step = (cells + mostCells - 1) / mostCells;
    std::vector<float> ratios;
    bool isAny = false;
    for (Index first = 0; first < std::ssize(pings); first += cells) {
        ratios.clear();
        for (Index cell = 0; cell < cells; cell += step)
            if (const float p = pings[std::size_t(first + cell)]; isNoise(lnNoise[std::size_t(cell)]) && !std::isnan(p))
                ratios.push_back(p * std::exp(-lnNoise[std::size_t(cell)]));
        if (std::ssize(ratios) < fewestPingLevelCells)
            continue;
        const double chance = 4.5 * medianScatter(double(ratios.size()));
        const float level = medianOf(ratios) / std::numbers::ln2_v<float>;
        if (!(level > 0.0f && std::abs(std::log(double(level))) > chance))
            continue;
        isAny = true;
        for (float &p : pings.subspan(std::size_t(first), std::size_t(cells)))
            p /= level;
    }
    return isAny;
}

std::vector<float> pingBlockNoise(std::vector<float> &pings, const BeamLayout &layout,
                                  const PingNoiseSettings &settings)
{
    const auto noise = [&] {
        const Index cells = layout.cells();
        const std::vector<float> medians = cellMedians(pings, cells);
        std::vector<float> estimate = firstEstimate(medians, layout, double(std::ssize(pings) / cells), settings);
        refineEstimate(estimate, pings, layout, settings);
        return estimate;
    };
    std::vector<float> estimate = noise();
    if (settings.followPing && levelPings(pings, estimate))
        estimate = noise();
    return estimate;
}

} // namespace faintline
