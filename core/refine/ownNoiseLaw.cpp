#include "refine/ownNoiseLaw.h"

#include "refine/constants.h"
#include "refine/pathStrips.h"
#include "refine/secondLook.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <utility>

namespace faintline {

namespace {

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
        std::vector<float> sums(cells.size());
        for (Index first = 0; first + length <= sample.rows(); first += length) {
            std::ranges::fill(sums, 0.0f);
            for (Index row = first; row < first + length; ++row)
                for (std::size_t i = 0; i < cells.size(); ++i)
                    sums[i] += std::min(sample.at(row, cells[i]), runPowerLimit); // NaN stays
            for (const float sum : sums)
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
    m_parts.resize(std::size_t(std::clamp<Index>(m_cells / fewestLawCells, 1, mostLawParts)));
    if (frames.time().count < fewestFrames)
        return;
    const NoiseSample sample(frames, tracks, binsPerCell, context);
    const Index parts = std::ssize(m_parts);
    for (Index part = 0; part < parts; ++part) {
        const Index all = sample.rows() * ((part + 1) * m_cells / parts - part * m_cells / parts);
        std::vector<float> values;
        values.reserve(std::size_t(all)); // as large as the sample; growing would take three times that
        std::vector<Index> cells;
        for (Index cell = part * m_cells / parts; cell < (part + 1) * m_cells / parts; ++cell)
            if (const std::vector<float> noise = sample.noiseIn(cell); !noise.empty()) {
                values.insert(values.end(), noise.begin(), noise.end());
                cells.push_back(cell);
            }
        const std::size_t count = values.size();
        setPowers(m_parts[std::size_t(part)], std::move(values));
        if (double(count) >= leastNoiseShare * double(all))
            setRuns(m_parts[std::size_t(part)], sample, cells, overlap);
    }
}

void OwnNoiseLaw::setPowers(Part &part, std::vector<float> values)
{
    if (values.size() < fewestLawValues)
        return;
    const auto count = double(values.size());
    bool isExponential = true;
    std::vector<float> quantiles{0.0f};
    std::vector<float> worths{0.0f};
    auto end = values.end(); // of those above the quantile before
    for (std::ptrdiff_t beyond = std::ssize(values) / 2; beyond >= fewestQuantileValues; beyond /= 2) {
        std::nth_element(values.begin(), values.begin() + beyond, end, std::greater<>());
        end = values.begin() + beyond;
        const float y = values[std::size_t(beyond)];
        const double g = -std::log(double(beyond) / count);
        const double error =
            quantileErrorShare * double(y) + sureLawDeviations * std::sqrt(valuesAlike / double(beyond));
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
            std::clamp((part.g[last] - part.g[last - 3]) / (part.y[last] - part.y[last - 3]), leastTailSlope, 1.0f);
}

void OwnNoiseLaw::setRuns(Part &part, const NoiseSample &sample, const std::vector<Index> &cells, double overlap)
{
    const Scatter single = meansOf(sample, cells, 1);
    if (single.count < Index(fewestLawValues))
        return;
    std::vector<double> runs{1.0};
    for (Index length = 2; length <= NoiseSample::runFrames; length *= 2) {
        const Scatter means = meansOf(sample, cells, length);
        const auto count = double(means.count);
        double ratio = 1.0;
        if (means.count >= fewestRunMeans)
            ratio = means.variance() * double(length) / (single.variance() * overlap);
        const bool isSure = ratio > 1.0 + runErrorShare + sureLawDeviations * std::sqrt(2.0 * valuesAlike / count);
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

NoiseSample::NoiseSample(const NormalisedFrames &frames, std::span<const Track> tracks, double binsPerCell,
                         const RunContext &context)
    : m_cells(frames.grid().size())
{
    const Index count = frames.time().count;
    m_distance = runFrames * std::max<Index>(1, Index(std::ceil(double(count) * double(m_cells) / noiseSampleValues)));
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
            mask(track, Index(std::ceil(maskedCells * binsPerCell)));
}

std::vector<float> NoiseSample::noiseIn(Index cell) const
{
    std::vector<float> values;
    for (Index row = 0; row < m_rows; ++row)
        if (const float y = at(row, cell); !std::isnan(y))
            values.push_back(y);
    const auto count = double(values.size());
    if (values.size() < 2 || count < leastObservedShare * double(m_rows))
        return {};
    // A line's median is above the limit if no more values lie below it than below a median.
    const double limit = lineMedianRatio + 4.0 * std::sqrt(2.0 / count);
    const auto below = std::ranges::count_if(values, [&](float y) { return !(double(y) / std::numbers::ln2 > limit); });
    return below <= (std::ssize(values) - 1) / 2 ? std::vector<float>() : values;
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
        mask(point, maskedFrames, maskedFrames, half);
    mask(track.points.front(), maskedFramesBeyond, 0, half);
    mask(track.points.back(), 0, maskedFramesBeyond, half);
}

namespace {

    /// ln Λ against noise of n exponential cells with this mean.
    double evidence(double count, double mean)
    {
        return mean > 1.0 ? count * (mean - 1.0 - std::log(mean)) : 0.0;
    }

} // namespace

OwnNoiseLaw ownNoiseLaw(const AnalysisPlan &analysis, std::span<const Track> tracks, const RunContext &context)
{
    const NormalisedFrames &frames = *analysis.frames;
    return {frames, tracks, frames.geometry().binsPerCell, frames.geometry().overlap(), context};
}

double evidenceLeft(const PathStrip &strip, const OwnNoiseLaw &law)
{
    if (law.isAsAssumed())
        return 1.0;
    double runs = 0.0;
    double count = 0.0;
    double power = 0.0;
    double own = 0.0;
    for (Index at = 0; at < strip.frameCount(); ++at) {
        const Index centre = strip.centres[std::size_t(at)];
        if (const float y = strip.valueAt(at, centre); !std::isnan(y)) {
            count += 1.0;
            power += double(y);
            own += double(law(centre, y));
            runs += law.runs(centre, strip.frameCount());
        }
    }
    const double all = evidence(count, power / count);
    return all > 0.0 ? evidence(count, own / count) / all * count / runs : 1.0;
}

void holdAgainstOwnNoise(Analysis &analysis, const RunContext &context)
{
    const AnalysisSettings &settings = analysis.settings;
    if (!looksTwice(analysis) || !settings.family.isNone() || settings.noise.causal || analysis.tracks.empty())
        return;
    const OwnNoiseLaw law = ownNoiseLaw(analysis, analysis.tracks, context.part(0.0, 0.5));
    if (law.isAsAssumed())
        return;
    std::vector<Track> tracks = std::exchange(analysis.tracks, {});
    std::vector<PathStrip> strips;
    for (const Track &track : tracks)
        strips.push_back(stripAlong(track, 0));
    readStrips(analysis, strips, context.part(0.5, 1.0), "testing tracks against the noise");
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        const bool isKept =
            tracks[i].isSubtracted || tracks[i].peakStatistic * evidenceLeft(strips[i], law) >= analysis.threshold;
        (isKept ? analysis.tracks : analysis.explainedByNoise).push_back(std::move(tracks[i]));
    }
}

} // namespace faintline
