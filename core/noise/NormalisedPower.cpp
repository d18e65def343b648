#include "noise/NormalisedPower.h"

#include "base/Error.h"
#include "base/memoryShares.h"
#include "noise/averageWhileSteady.h"
#include "noise/blockBackground.h"
#include "noise/constants.h"
#include "noise/dither.h"
#include "noise/levels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <tuple>

namespace faintline {

namespace {

    constexpr Index mostPowerBlocks = 256;
    constexpr Index powersPerBlock = Index(1) << 20;
    constexpr Index fewestRowsPerBlock = 16;
    constexpr Index mostCells = Index(1) << 20;

    float quantile(std::vector<float> &values, double p)
    {
        const auto at = values.begin() + Index(p * double(values.size() - 1));
        std::nth_element(values.begin(), at, values.end());
        return *at;
    }

    /// Replaces values that were not observed by 0, for medians over time.
    void withoutUnobserved(std::vector<float> &values)
    {
        for (float &value : values)
            value = value > 0.0f && std::isfinite(value) ? value : 0.0f;
    }

    /// Estimates B of a part from blocks of frames evenly spread over it.
    NoiseBackground estimate(const Axis &time, const Axis &frequency, const NormaliserSettings &settings,
                             const RunContext &context, const std::function<std::vector<float>(Index frame)> &readFrame)
    {
        const Index cells = frequency.count;
        const Index most =
            std::clamp<Index>(Index(memoryShares::background / sizeof(float)) / cells, 1, mostPowerBlocks);
        const Index wanted = std::max(Index(std::llround(settings.blockWindows)), (time.count + most - 1) / most);
        const Index blocks = std::max<Index>(1, time.count / wanted);
        const double blockFrames = double(time.count) / double(blocks);
        const double atMost = double(std::max(fewestRowsPerBlock, powersPerBlock / cells));
        const double stride = std::max(1.0, blockFrames / atMost);

        NoiseBackground background;
        background.time = {"time", "s", time.value(0.5 * (blockFrames - 1.0)), blockFrames * time.step, blocks, false};
        background.frequency = frequency;
        background.levelTime = background.time;
        std::vector<float> rows;
        std::vector<float> block;
        for (Index b = 0; b < blocks; ++b) {
            context.checkpoint(double(b) / double(blocks), "noise background");
            block.clear();
            const double end = std::min(double(b + 1) * blockFrames, double(time.count));
            for (double frame = double(b) * blockFrames; frame < end; frame += stride) {
                const std::vector<float> row = readFrame(Index(frame));
                block.insert(block.end(), row.begin(), row.end());
            }
            withoutUnobserved(block);
            BlockMedians typical(block, cells);
            flatten(block, cells, typical);
            const BlockBackground own = blockBackground(typical, settings.halfWidthCells);
            background.lnPower.insert(background.lnPower.end(), own.medians.begin(), own.medians.end());
            rows.insert(rows.end(), own.lnPower.begin(), own.lnPower.end());
        }
        averageWhileSteady(background.lnPower, rows, cells, settings.halfWidthCells, std::min(atMost, blockFrames));
        return background;
    }

    Axis partOfAxis(Axis axis, Index first, Index count)
    {
        axis.first = axis.value(double(first));
        axis.count = count;
        return axis;
    }

} // namespace

NormalisedPower::NormalisedPower(std::shared_ptr<const PowerFrames> power, const PowerPart &part,
                                 const NormaliserSettings &settings, const RunContext &context)
    : NormalisedFrames(partOfAxis(power->info().time, part.firstFrame, part.frames),
                       Grid{{partOfAxis(power->info().frequency, part.firstCell, part.cells)}}),
      m_power(std::move(power)), m_part(part), m_law(1.0, LooksLaw::quantile(1.0, 0.5))
{
    const std::string &path = m_power->info().path;
    const Axis &frequency = grid().axes.front();
    m_part.hasDc = m_part.hasDc || !settings.blankDc;
    if (settings.causal)
        throw fieldError("noise.causal", "true", "requires samples; " + path + " holds power over time and frequency");
    if (part.cells > mostCells)
        throw Error(path,
                    "has " + std::to_string(part.cells)
                        + " channels, more than can be analysed together; choose a band (--set selection.lowHz=..., "
                          "selection.highHz=...)");
    m_background = estimate(time(), frequency, settings, context, [this](Index frame) { return readPower(frame, 1); });

    // The spread of the normalised values gives the number of averaged looks.
    const Index step = std::max<Index>(1, time().count / 64);
    const Index cellStep = std::max<Index>(1, part.cells / 4096);
    std::vector<float> pooled;
    std::vector<float> scratch;
    for (Index frame = 0; frame < time().count; frame += step) {
        std::vector<float> values = readPower(frame, 1);
        divide(frame, values, scratch);
        for (Index cell = 0; cell < part.cells; cell += cellStep)
            if (const float value = values[std::size_t(cell)]; std::isfinite(value))
                pooled.push_back(value);
    }
    if (pooled.empty() || !(quantile(pooled, 0.5) > 0.0f))
        throw Error(path, "holds no power in most of its channels: their values are 0, negative or not finite");
    const double low = double(quantile(pooled, 0.16));
    const double high = double(quantile(pooled, 0.84));
    m_law = LooksLaw::fromQuantiles(low, double(quantile(pooled, 0.5)), high);
}

std::vector<float> NormalisedPower::readPower(Index first, Index count) const
{
    PowerPart part = m_part;
    part.firstFrame += first;
    part.frames = count;
    std::vector<float> values(std::size_t(count * m_part.cells));
    m_power->read(part, values);
    const auto quantum = float(m_power->info().quantum);
    if (quantum > 0.0f) {
        const Index all = m_power->info().frequency.count;
        for (Index i = 0; i < std::ssize(values); ++i) {
            const Index frame = part.firstFrame + i / m_part.cells;
            const Index cell = m_part.firstCell + i % m_part.cells;
            values[std::size_t(i)] += quantum * uniformAt(std::uint64_t(frame * all + cell));
        }
    }
    return values;
}

/// p → p/B; NaN if the noise is unknown.
void NormalisedPower::divide(Index frame, std::span<float> values, std::vector<float> &ln) const
{
    ln.resize(values.size());
    m_background.readLnPower(time().value(double(frame)), ln);
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
        const float p = std::max(values[cell], 0.0f); // keeps NaN
        const bool isKnown = ln[cell] > 0.5f * NoiseBackground::silence && std::isfinite(p);
        values[cell] = isKnown ? p * std::exp(-ln[cell]) : std::numeric_limits<float>::quiet_NaN();
    }
}

void NormalisedPower::read(Index first, Index count, std::span<float> out) const
{
    const std::vector<float> power = readPower(first, count);
    std::copy(power.begin(), power.end(), out.begin());
    const auto cells = std::size_t(m_part.cells);
    const std::size_t stride = (cells + powerLevelCells - 1) / powerLevelCells;
    const double chance = 4.5 * medianScatter(double((cells + stride - 1) / stride)) / std::sqrt(m_law.looks());
    std::vector<float> ln;
    std::vector<float> some;
    for (Index i = 0; i < count; ++i) {
        const std::span<float> frame = out.subspan(std::size_t(i) * cells, cells);
        divide(first + i, frame, ln);
        some.clear();
        for (std::size_t cell = 0; cell < cells; cell += stride)
            if (std::isfinite(frame[cell]))
                some.push_back(frame[cell] / m_law.median());
        const float level = some.empty() ? 1.0f : medianOf(some);
        const bool isOff = level > 0.0f && cells >= powerLevelCells / 10 && std::abs(std::log(double(level))) > chance;
        for (float &value : frame)
            value = value == value ? m_law(isOff ? value / level : value) : value;
    }
}

PowerPart partOf(const PowerInfo &info, const SelectionSettings &selection)
{
    checkChannel(selection, info.path, info.channelCount);
    const auto between = [&](const Axis &axis, double from, double to, const std::string &name) {
        const auto place = [&](double value) { return std::clamp(axis.position(value), -1.0, double(axis.count)); };
        const Index first = std::max<Index>(0, Index(std::ceil(place(from))));
        const Index last = std::min<Index>(axis.count - 1, Index(std::floor(place(to))));
        if (last < first)
            throw Error(name, "selects nothing of " + info.path + ", which extends from " + formatNumber(axis.first)
                                  + " to " + formatNumber(axis.last()) + " " + axis.unit);
        return std::pair(first, last - first + 1);
    };
    PowerPart part{selection.channel, 0, info.time.count, 0, info.frequency.count};
    const double end = selection.toSeconds > 0.0 ? selection.toSeconds : info.time.last() + info.time.step;
    std::tie(part.firstFrame, part.frames) =
        between(info.time, selection.fromSeconds, end, "selection.fromSeconds, selection.toSeconds");
    if (!isWholeBand(selection))
        std::tie(part.firstCell, part.cells) =
            between(info.frequency, selection.lowHz, selection.highHz, "selection.lowHz, selection.highHz");
    return part;
}

} // namespace faintline
