#include "refine/ownNoiseLaw.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace faintline {

namespace {

    constexpr Index fewestFrames = 64;
    constexpr Index partLimit = 16;
    constexpr Index fewestCells = 40;         ///< of a part
    constexpr std::size_t fewestValues = 500; ///< of a part
    constexpr std::ptrdiff_t quantileMinimumValues = 60;
    constexpr double likeValues = 4.0; ///< values that count as one, because windows and bins overlap
    constexpr double sureDeviations = 3.0;
    constexpr double quantileErrorShare = 0.03;
    constexpr float tailMinimumSlope = 0.05f;
    constexpr float runPowerLimit = 5.0f; ///< limit of powers for measuring runs
    constexpr double runErrorShare = 0.05;
    constexpr Index runMinimumMeans = 60;
    constexpr double noiseMinimumShare = 0.5; ///< fraction of a part's cells needed to measure runs

    /// Running sums of values.
    struct Scatter {
        Index count = 0;
        double sum = 0.0;
        double squares = 0.0;

        void add(double value)
        {
            ++count;
            sum += value;
            squares += value * value;
        }
        double variance() const { return squares / double(count) - sum * sum / double(count) / double(count); }
    };

    /// Means over `length` successive frames of a run in which all values are noise.
    Scatter meansOf(const NoiseSample &sample, const std::vector<Index> &cells, Index length)
    {
        Scatter scatter;
        for (const Index cell : cells)
            for (Index first = 0; first + length <= sample.rows(); first += length) {
                float sum = 0.0f;
                for (Index row = first; row < first + length; ++row)
                    sum += std::isnan(sample.at(row, cell)) ? sample.at(row, cell)
                                                            : std::min(sample.at(row, cell), runPowerLimit);
                if (!std::isnan(sum))
                    scatter.add(double(sum) / double(length));
            }
        return scatter;
    }

} // namespace

OwnNoiseLaw::OwnNoiseLaw(const NormalisedFrames &frames, std::span<const Track> tracks, double binsPerCell,
                         double overlap, const RunContext &context)
    : m_cells(frames.grid().size())
{
    m_parts.resize(std::size_t(std::clamp<Index>(m_cells / fewestCells, 1, partLimit)));
    if (frames.time().count < fewestFrames)
        return;
    const NoiseSample sample(frames, tracks, binsPerCell, context);
    const Index parts = std::ssize(m_parts);
    for (Index part = 0; part < parts; ++part) {
        std::vector<float> values;
        std::vector<Index> cells;
        for (Index cell = part * m_cells / parts; cell < (part + 1) * m_cells / parts; ++cell)
            if (const std::vector<float> noise = sample.noiseIn(cell); !noise.empty()) {
                values.insert(values.end(), noise.begin(), noise.end());
                cells.push_back(cell);
            }
        const std::size_t count = values.size();
        setPowers(m_parts[std::size_t(part)], std::move(values));
        const Index all = sample.rows() * ((part + 1) * m_cells / parts - part * m_cells / parts);
        if (double(count) >= noiseMinimumShare * double(all))
            setRuns(m_parts[std::size_t(part)], sample, cells, overlap);
    }
}

void OwnNoiseLaw::setPowers(Part &part, std::vector<float> values)
{
    if (values.size() < fewestValues)
        return;
    std::sort(values.begin(), values.end(), std::greater<>());
    const auto count = double(values.size());
    bool isExponential = true;
    std::vector<float> quantiles{0.0f};
    std::vector<float> worths{0.0f};
    for (std::ptrdiff_t beyond = std::ssize(values) / 2; beyond >= quantileMinimumValues; beyond /= 2) {
        const float y = values[std::size_t(beyond)];
        const double g = -std::log(double(beyond) / count);
        const double error = quantileErrorShare * double(y) + sureDeviations * std::sqrt(likeValues / double(beyond));
        isExponential = isExponential && double(y) - g < error;
        quantiles.push_back(y);
        worths.push_back(std::min(y, float(g)));
    }
    if (isExponential)
        return;
    part.y = std::move(quantiles);
    part.g = std::move(worths);
    const std::size_t last = part.y.size() - 1;
    if (last >= 4 && part.y[last] > part.y[last - 3])
        part.slope =
            std::clamp((part.g[last] - part.g[last - 3]) / (part.y[last] - part.y[last - 3]), tailMinimumSlope, 1.0f);
}

void OwnNoiseLaw::setRuns(Part &part, const NoiseSample &sample, const std::vector<Index> &cells, double overlap)
{
    const Scatter single = meansOf(sample, cells, 1);
    if (single.count < Index(fewestValues))
        return;
    std::vector<double> runs{1.0};
    for (Index length = 2; length <= NoiseSample::runFrames; length *= 2) {
        const Scatter means = meansOf(sample, cells, length);
        const auto count = double(means.count);
        double ratio = 1.0;
        if (means.count >= runMinimumMeans)
            ratio = means.variance() * double(length) / (single.variance() * overlap);
        const bool isSure = ratio > 1.0 + runErrorShare + sureDeviations * std::sqrt(2.0 * likeValues / count);
        runs.push_back(isSure ? std::max(ratio, runs.back()) : runs.back());
    }
    if (runs.back() > 1.0)
        part.runs = std::move(runs);
}

bool OwnNoiseLaw::isAsAssumed() const
{
    return std::all_of(m_parts.begin(), m_parts.end(),
                       [](const Part &part) { return part.y.empty() && part.runs.empty(); });
}

const OwnNoiseLaw::Part &OwnNoiseLaw::partAt(Index cell) const
{
    const Index parts = std::ssize(m_parts);
    return m_parts[std::size_t(std::min(((cell + 1) * parts - 1) / m_cells, parts - 1))];
}

double OwnNoiseLaw::runs(Index cell, Index n) const
{
    const std::vector<double> &runs = partAt(cell).runs;
    if (runs.empty())
        return 1.0;
    const double octave = std::min(std::log2(double(n)), double(runs.size() - 1));
    const auto below = std::min(std::size_t(octave), runs.size() - 2);
    return std::lerp(runs[below], runs[below + 1], octave - double(below));
}

float OwnNoiseLaw::operator()(Index cell, float y) const
{
    const Part &part = partAt(cell);
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
