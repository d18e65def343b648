#include "scene/SimulatedPings.h"

#include "base/Random.h"
#include "base/logmath.h"
#include "base/multiversion.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace faintline {

namespace {

    constexpr float halfPower = std::numbers::sqrt2_v<float> / 2.0f; ///< deviation of each part of the noise

    FAINTLINE_MULTIVERSION
    void addPowers(const float *noise, Index cells, float *power)
    {
        for (Index i = 0; i < cells; ++i)
            power[i] += noise[2 * i] * noise[2 * i] + noise[2 * i + 1] * noise[2 * i + 1];
    }

    /// Power of a target in a ping over its mean: drawn once for the whole track, or once for each ping. The streams'
    /// numbers are above those of the pings' noise.
    double fluctuationOf(const PingScene &scene, std::size_t target, Index ping)
    {
        constexpr std::uint64_t firstStream = std::uint64_t(1) << 56;
        const Fluctuation fluctuation = scene.targets[target].fluctuation;
        const auto draw = changesFromFrameToFrame(fluctuation) ? std::uint64_t(ping) : 0;
        Random random(std::uint64_t(scene.seed), firstStream + (std::uint64_t(target) << 32) + draw);
        return relativePower(fluctuation, random);
    }

    /// Range half width of the window around a cell, shorter at the axis's ends so that the cell stays in its middle.
    Index windowAt(Index range, Index rangeCells)
    {
        constexpr Index filterLimitCells = 16;
        constexpr Index filterMinimumCells = 4;
        return std::clamp(std::min(range, rangeCells - 1 - range), filterMinimumCells, filterLimitCells);
    }

} // namespace

SimulatedPings::SimulatedPings(const PingScene &scene)
    : NormalisedFrames(pingTime(scene), pingGrid(scene)), m_scene(scene)
{
    checkScene(scene);
    m_truth = pingTruth(scene);
    for (Index range = 0; range < scene.rangeCells; ++range)
        m_background.push_back(float(backgroundPower(scene, range)));
}

void SimulatedPings::read(Index first, Index count, std::span<float> out) const
{
    const auto cells = std::size_t(grid().size());
    for (Index i = 0; i < count; ++i)
        readPing(first + i, out.subspan(std::size_t(i) * cells, cells));
}

void SimulatedPings::readPing(Index ping, std::span<float> y) const
{
    const Index cells = grid().size();
    std::vector<float> noise(2 * y.size());
    std::fill(y.begin(), y.end(), 0.0f);
    Random random(std::uint64_t(m_scene.seed), std::uint64_t(ping));
    // Echoes interfere with the noise look by look, so the noise of their cells is stored.
    std::vector<float> kept;
    std::vector<Index> occupied;
    for (const TruthTarget &target : m_truth.targets)
        if (const Index cell = target.cellAt(ping);
            cell >= 0 && std::find(occupied.begin(), occupied.end(), cell) == occupied.end())
            occupied.push_back(cell);
    std::sort(occupied.begin(), occupied.end());
    for (int look = 0; look < m_scene.looks; ++look) {
        random.normals(noise, halfPower);
        addPowers(noise.data(), cells, y.data());
        for (Index cell : occupied)
            kept.insert(kept.end(), noise.begin() + 2 * cell, noise.begin() + 2 * cell + 2);
    }
    const float share = 1.0f / float(m_scene.looks);
    const Index perRange = grid().stride(0);
    for (Index range = 0; range < m_scene.rangeCells; ++range)
        for (float &value : y.subspan(std::size_t(range * perRange), std::size_t(perRange)))
            value *= share * m_background[std::size_t(range)];
    if (!occupied.empty())
        addEchoes(ping, kept, y);

    if (m_scene.reverberation && m_scene.reverberation->normalisation == PingNormalisation::Estimated)
        divideByEstimate(y);
    else if (m_scene.reverberation)
        for (Index range = 0; range < m_scene.rangeCells; ++range)
            for (float &value : y.subspan(std::size_t(range * perRange), std::size_t(perRange)))
                value /= m_background[std::size_t(range)];
}

void SimulatedPings::addEchoes(Index ping, std::span<const float> noise, std::span<float> power) const
{
    struct EchoSum {
        double constant = 0.0;    ///< powers added to the cell's
        double fluctuating = 0.0; ///< powers that scale the noise's
        double amplitude = 0.0;
    };
    std::map<Index, EchoSum> sums;
    for (std::size_t i = 0; i < m_truth.targets.size(); ++i) {
        const Index cell = m_truth.targets[i].cellAt(ping);
        if (cell < 0)
            continue;
        const double snr = ratioFromDb(m_scene.targets[i].snrDb) * fluctuationOf(m_scene, i, ping);
        EchoSum &sum = sums[cell];
        switch (m_scene.targets[i].echo) {
        case Echo::Constant:
            sum.constant += snr;
            break;
        case Echo::Fluctuating:
            sum.fluctuating += snr;
            break;
        case Echo::Complex:
            sum.amplitude += std::sqrt(snr);
            break;
        }
    }
    std::size_t number = 0;
    for (const auto &[cell, sum] : sums) {
        const double background = double(m_background[std::size_t(cell / grid().stride(0))]);
        // The noise's phase is uniform and independent in each look, so the echo's phase need not be drawn.
        double total = 0.0;
        for (int look = 0; look < m_scene.looks; ++look) {
            const std::size_t at = 2 * (std::size_t(look) * sums.size() + number);
            const double scale = std::sqrt(background + sum.fluctuating);
            const double real = scale * double(noise[at]) + sum.amplitude;
            const double imaginary = scale * double(noise[at + 1]);
            total += real * real + imaginary * imaginary;
        }
        power[std::size_t(cell)] = float(total / m_scene.looks + sum.constant);
        ++number;
    }
}

void SimulatedPings::divideByEstimate(std::span<float> power) const
{
    constexpr Index guardRanges = 2;
    constexpr Index guardBeams = 1;
    const Index ranges = m_scene.rangeCells;
    const Index beams = m_scene.beams;
    std::vector<double> rows(std::size_t(ranges) + 1, 0.0); // Σ over beams and over the preceding ranges
    for (Index range = 0; range < ranges; ++range) {
        double sum = 0.0;
        for (Index beam = 0; beam < beams; ++beam)
            sum += double(power[std::size_t(range * beams + beam)]);
        rows[std::size_t(range) + 1] = rows[std::size_t(range)] + sum;
    }
    const std::vector<float> raw(power.begin(), power.end());
    for (Index range = 0; range < ranges; ++range) {
        const Index half = windowAt(range, ranges);
        const Index from = std::max<Index>(0, range - half);
        const Index to = std::min(ranges - 1, range + half);
        const double all = rows[std::size_t(to) + 1] - rows[std::size_t(from)];
        for (Index beam = 0; beam < beams; ++beam) {
            double guarded = 0.0;
            Index guardedCount = 0;
            for (Index r = std::max(from, range - guardRanges); r <= std::min(to, range + guardRanges); ++r)
                for (Index b = -std::min(guardBeams, (beams - 1) / 2); b <= std::min(guardBeams, (beams - 1) / 2); ++b)
                    if (const Index inside = grid().axes[1].wrapped(beam + b); inside >= 0) {
                        guarded += double(raw[std::size_t(r * beams + inside)]);
                        ++guardedCount;
                    }
            const auto count = double((to - from + 1) * beams - guardedCount);
            const double looks = count * m_scene.looks;
            const double mean = (all - guarded) / count * looks / (looks - 1.0);
            auto &value = power[std::size_t(range * beams + beam)];
            value = mean > 0.0 ? float(double(value) / mean) : 0.0f;
        }
    }
}

} // namespace faintline
