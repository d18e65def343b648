#include "analysis/ownNoiseLaw.h"

#include "spectrum/levels.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace faintline {

namespace {

    constexpr double mostValues = 4e6;
    constexpr double cellsBeside = 4.0; ///< resolution cells, on either side of a track
    constexpr Index framesBeside = 2;
    constexpr Index framesBeyond = 10; ///< its ends
    constexpr Index fewestFrames = 128;
    constexpr Index mostParts = 16;
    constexpr Index fewestCells = 40;         ///< of a part
    constexpr std::size_t fewestValues = 500; ///< of a part
    constexpr std::ptrdiff_t fewestBeyond = 60;
    constexpr double alike = 4.0; ///< values that go for one, for windows and bins overlap
    constexpr double deviations = 3.0;
    constexpr double levelError = 0.03;
    constexpr float lowestSlope = 0.05f;
    constexpr double leastObserved = 0.2; ///< of a bin's frames
    constexpr double raised = 1.1;        ///< median of a bin with a steady line, over noise's, but for its scatter

    /// Frames at even distances, row by row; NaN where there may be a signal.
    struct Sample {
        Index stride;
        Index rows;
        Index cells;
        std::vector<float> y;

        float &at(Index row, Index cell) { return y[std::size_t(row * cells + cell)]; }
    };

    Sample sampleOf(const NormalisedFrames &frames, const RunContext &context)
    {
        Sample sample;
        sample.cells = frames.grid().size();
        const Index count = frames.time().count;
        sample.stride = std::max<Index>(1, Index(std::ceil(double(count) * double(sample.cells) / mostValues)));
        sample.rows = (count + sample.stride - 1) / sample.stride;
        sample.y.resize(std::size_t(sample.rows * sample.cells));
        for (Index row = 0; row < sample.rows; ++row) {
            context.checkpoint(double(row) / double(sample.rows), "measuring the noise");
            frames.read(row * sample.stride, 1, {&sample.at(row, 0), std::size_t(sample.cells)});
        }
        return sample;
    }

    void mask(Sample &sample, Index firstFrame, Index lastFrame, Index firstCell, Index lastCell)
    {
        const Index first = std::max<Index>(0, firstFrame + sample.stride - 1) / sample.stride;
        const Index last = std::min(sample.rows - 1, lastFrame / sample.stride);
        for (Index row = first; row <= last; ++row)
            for (Index cell = std::max<Index>(0, firstCell); cell <= std::min(sample.cells - 1, lastCell); ++cell)
                sample.at(row, cell) = std::numeric_limits<float>::quiet_NaN();
    }

    void maskTrack(Sample &sample, const std::vector<TrackPoint> &points, Index half)
    {
        const auto around = [&](const TrackPoint &point, Index before, Index behind) {
            mask(sample, point.frame - before, point.frame + behind, point.cell - half, point.cell + half);
        };
        for (const TrackPoint &point : points)
            around(point, framesBeside, framesBeside);
        around(points.front(), framesBeyond, 0);
        around(points.back(), 0, framesBeyond);
    }

    /// What a bin holds over time; nothing where that is no noise, or little of it is known.
    std::vector<float> noiseIn(Sample &sample, Index cell)
    {
        std::vector<float> values;
        for (Index row = 0; row < sample.rows; ++row)
            if (const float y = sample.at(row, cell); y > 0.0f)
                values.push_back(y);
        const auto count = double(values.size());
        if (values.size() < 2 || count < leastObserved * double(sample.rows))
            return {};
        const double level = double(medianOf(values)) / std::numbers::ln2;
        return level > raised + 4.0 * std::sqrt(2.0 / count) ? std::vector<float>() : values;
    }

} // namespace

OwnNoiseLaw::OwnNoiseLaw(const NormalisedFrames &frames, std::span<const Track> tracks, double binsPerCell,
                         const RunContext &context)
    : m_cells(frames.grid().size())
{
    m_parts.resize(std::size_t(std::clamp<Index>(m_cells / fewestCells, 1, mostParts)));
    if (frames.time().count < fewestFrames)
        return;
    Sample sample = sampleOf(frames, context);
    for (const Track &track : tracks)
        if (!track.points.empty())
            maskTrack(sample, track.points, Index(std::ceil(cellsBeside * binsPerCell)));
    const Index parts = std::ssize(m_parts);
    for (Index part = 0; part < parts; ++part) {
        std::vector<float> values;
        for (Index cell = part * m_cells / parts; cell < (part + 1) * m_cells / parts; ++cell) {
            const std::vector<float> noise = noiseIn(sample, cell);
            values.insert(values.end(), noise.begin(), noise.end());
        }
        m_parts[std::size_t(part)] = partOf(std::move(values));
    }
}

OwnNoiseLaw::Part OwnNoiseLaw::partOf(std::vector<float> values)
{
    if (values.size() < fewestValues)
        return {};
    std::sort(values.begin(), values.end(), std::greater<>());
    const auto count = double(values.size());
    bool isExponential = true;
    Part part{{0.0f}, {0.0f}};
    for (std::ptrdiff_t beyond = std::ssize(values) / 2; beyond >= fewestBeyond; beyond /= 2) {
        const float y = values[std::size_t(beyond)];
        const double g = -std::log(double(beyond) / count);
        const double error = levelError * double(y) + deviations * std::sqrt(alike / double(beyond));
        isExponential = isExponential && double(y) - g < error;
        part.y.push_back(y);
        part.g.push_back(std::min(y, float(g)));
    }
    if (isExponential)
        return {};
    const std::size_t last = part.y.size() - 1;
    if (last >= 4 && part.y[last] > part.y[last - 3])
        part.slope =
            std::clamp((part.g[last] - part.g[last - 3]) / (part.y[last] - part.y[last - 3]), lowestSlope, 1.0f);
    return part;
}

bool OwnNoiseLaw::isExponential() const
{
    return std::all_of(m_parts.begin(), m_parts.end(), [](const Part &part) { return part.y.empty(); });
}

float OwnNoiseLaw::operator()(Index cell, float y) const
{
    const Index parts = std::ssize(m_parts);
    const Part &part = m_parts[std::size_t(std::min(((cell + 1) * parts - 1) / m_cells, parts - 1))];
    if (part.y.empty() || !(y > 0.0f))
        return y;
    const auto above = std::upper_bound(part.y.begin(), part.y.end(), y);
    if (above == part.y.end())
        return std::min(y, part.g.back() + part.slope * (y - part.y.back()));
    const auto i = std::size_t(above - part.y.begin());
    const float share = (y - part.y[i - 1]) / (part.y[i] - part.y[i - 1]);
    return std::min(y, part.g[i - 1] + share * (part.g[i] - part.g[i - 1]));
}

} // namespace faintline
