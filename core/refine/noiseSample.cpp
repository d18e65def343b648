#include "refine/noiseSample.h"

#include "noise/levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace faintline {

namespace {

    constexpr double sampleLimitValues = 4e6;
    constexpr double cellsBeside = 4.0; ///< resolution cells, on either side of a track
    constexpr Index framesBeside = 2;
    constexpr Index framesBeyond = 10;           ///< beyond its ends
    constexpr double observedMinimumShare = 0.2; ///< of a bin's frames
    constexpr double lineMedianRatio = 1.1; ///< median of a bin with a steady line, relative to noise, apart from its
                                            ///< scatter

} // namespace

NoiseSample::NoiseSample(const NormalisedFrames &frames, std::span<const Track> tracks, double binsPerCell,
                         const RunContext &context)
    : m_cells(frames.grid().size())
{
    const Index count = frames.time().count;
    m_distance = runFrames * std::max<Index>(1, Index(std::ceil(double(count) * double(m_cells) / sampleLimitValues)));
    for (Index first = 0; first < count; first += m_distance) {
        context.checkpoint(double(first) / double(count), "measuring the noise");
        const Index run = std::min(runFrames, count - first);
        m_y.resize(std::size_t((m_rows + run) * m_cells));
        frames.read(first, run, std::span(m_y).last(std::size_t(run * m_cells)));
        m_rows += run;
    }
    std::replace_if(
        m_y.begin(), m_y.end(), [](float y) { return !(y > 0.0f); }, std::numeric_limits<float>::quiet_NaN());
    for (const Track &track : tracks)
        if (!track.points.empty())
            mask(track, Index(std::ceil(cellsBeside * binsPerCell)));
}

std::vector<float> NoiseSample::noiseIn(Index cell) const
{
    std::vector<float> values;
    for (Index row = 0; row < m_rows; ++row)
        if (const float y = at(row, cell); !std::isnan(y))
            values.push_back(y);
    const auto count = double(values.size());
    if (values.size() < 2 || count < observedMinimumShare * double(m_rows))
        return {};
    const double level = double(medianOf(values)) / std::numbers::ln2;
    return level > lineMedianRatio + 4.0 * std::sqrt(2.0 / count) ? std::vector<float>() : values;
}

void NoiseSample::mask(const TrackPoint &point, Index before, Index behind, Index half)
{
    const Index low = std::max<Index>(0, point.cell - half);
    const Index high = std::min(m_cells - 1, point.cell + half);
    for (Index frame = std::max<Index>(0, point.frame - before); frame <= point.frame + behind; ++frame) {
        const Index row = frame / m_distance * runFrames + frame % m_distance;
        if (frame % m_distance < runFrames && row < m_rows)
            std::fill_n(m_y.begin() + row * m_cells + low, high - low + 1, std::numeric_limits<float>::quiet_NaN());
    }
}

void NoiseSample::mask(const Track &track, Index half)
{
    for (const TrackPoint &point : track.points)
        mask(point, framesBeside, framesBeside, half);
    mask(track.points.front(), framesBeyond, 0, half);
    mask(track.points.back(), 0, framesBeyond, half);
}

} // namespace faintline
