#include "noise/NoiseBackground.h"

#include "base/multiversion.h"
#include "noise/constants.h"
#include "noise/medians.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace faintline {

namespace {

    constexpr std::size_t sumLanes = 16; // number of partial sums, in the same order on each processor

    using Lanes = std::array<float, sumLanes>;

    FAINTLINE_MULTIVERSION
    void addSource(const float *colour, float level, std::size_t cells, float *sum)
    {
        for (std::size_t cell = 0; cell < cells; ++cell)
            sum[cell] += level * colour[cell];
    }

    /// B → min(y, cB)/B² and 1/B.
    FAINTLINE_MULTIVERSION
    void weigh(const float *frame, const float *sum, std::size_t cells, float *pull, float *inverse)
    {
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const float b = sum[cell] > lowestSourcePower ? sum[cell] : lowestSourcePower;
            const float over = 1.0f / b;
            const float y = frame[cell] < sourceLineLimit * b ? frame[cell] : sourceLineLimit * b;
            inverse[cell] = over;
            pull[cell] = y * over * over;
        }
    }

    FAINTLINE_MULTIVERSION
    void addProducts(const float *a, const float *b, std::size_t cells, float *parts)
    {
        std::size_t cell = 0;
        for (; cell + sumLanes <= cells; cell += sumLanes)
            for (std::size_t lane = 0; lane < sumLanes; ++lane)
                parts[lane] += a[cell + lane] * b[cell + lane];
        for (; cell < cells; ++cell)
            parts[cell % sumLanes] += a[cell] * b[cell];
    }

    double product(const float *a, const float *b, std::size_t cells)
    {
        Lanes parts{};
        addProducts(a, b, cells, parts.data());
        return std::accumulate(parts.begin(), parts.end(), 0.0);
    }

    /// Scratch memory for one frame's updates.
    struct UpdateScratch {
        std::vector<float> sum, pull, inverse;

        explicit UpdateScratch(std::size_t cells) : sum(cells), pull(cells), inverse(cells) {}
    };

    void weigh(const NoiseSources &sources, std::span<const float> frame, std::span<const float> levels,
               UpdateScratch &scratch)
    {
        sources.addUp(levels, scratch.sum);
        weigh(frame.data(), scratch.sum.data(), frame.size(), scratch.pull.data(), scratch.inverse.data());
    }

    void updateLevels(const NoiseSources &sources, std::span<const float> frame, std::vector<float> &levels,
                      UpdateScratch &scratch)
    {
        weigh(sources, frame, levels, scratch);
        for (std::size_t k = 0; k < levels.size(); ++k) {
            const float *colour = sources.colours.data() + k * frame.size();
            const double pull = product(colour, scratch.pull.data(), frame.size());
            const double inverse = product(colour, scratch.inverse.data(), frame.size());
            levels[k] = float(double(levels[k]) * (inverse > 0.0 ? pull / inverse : 0.0));
        }
    }

    /// Equal contributions of all sources.
    std::vector<float> firstLevels(const NoiseSources &sources, std::span<const float> frame)
    {
        const auto count = std::size_t(sources.count());
        std::vector<float> levels(count);
        for (std::size_t k = 0; k < count; ++k) {
            std::vector<float> ratios(frame.size());
            for (std::size_t cell = 0; cell < frame.size(); ++cell)
                ratios[cell] = frame[cell] / std::max(sources.colours[k * frame.size() + cell], lowestSourcePower);
            const auto middle = ratios.begin() + std::ssize(ratios) / 2;
            std::nth_element(ratios.begin(), middle, ratios.end());
            levels[k] = *middle / float(count);
        }
        return levels;
    }

    /// ln of a frame's means over ranges of cells, minus their median: a coarse colour.
    std::vector<float> profileOf(std::span<const float> frame)
    {
        const Index cells = std::ssize(frame);
        const Index parts = std::max<Index>(1, cells / sourceProfileCells);
        std::vector<float> profile;
        for (Index part = 0; part < parts; ++part) {
            std::vector<float> values(frame.begin() + part * cells / parts, frame.begin() + (part + 1) * cells / parts);
            const auto middle = values.begin() + std::ssize(values) / 2;
            std::nth_element(values.begin(), middle, values.end());
            profile.push_back(std::log(std::max(*middle, lowestSourcePower)));
        }
        std::vector<float> sorted = profile;
        std::nth_element(sorted.begin(), sorted.begin() + parts / 2, sorted.end());
        for (float &value : profile)
            value -= sorted[std::size_t(parts / 2)];
        return profile;
    }

    double distance(const std::vector<float> &a, const std::vector<float> &b)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i)
            sum += std::abs(double(a[i] - b[i]));
        return sum / double(a.size());
    }

    /// Initial colours: those of frames farthest from the ones already chosen, without the few most extreme, each
    /// averaged with its nearest frames.
    NoiseSources firstSources(std::span<const float> frames, Index cells, Index count)
    {
        std::vector<std::vector<float>> profiles;
        for (Index first = 0; first < std::ssize(frames); first += cells)
            profiles.push_back(profileOf(frames.subspan(std::size_t(first), std::size_t(cells))));
        std::vector<float> centre(profiles.front().size());
        for (std::size_t part = 0; part < centre.size(); ++part) {
            std::vector<float> values;
            for (const auto &profile : profiles)
                values.push_back(profile[part]);
            std::nth_element(values.begin(), values.begin() + std::ssize(values) / 2, values.end());
            centre[part] = values[values.size() / 2];
        }
        std::vector<double> far(profiles.size());
        for (std::size_t i = 0; i < profiles.size(); ++i)
            far[i] = distance(profiles[i], centre);
        NoiseSources result{cells, {}};
        std::vector<std::size_t> order(profiles.size());
        for (Index k = 0; k < count; ++k) {
            std::iota(order.begin(), order.end(), std::size_t(0));
            std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return far[a] > far[b]; });
            const std::size_t seed = order[std::size_t(oddestFrameShare * double(order.size()))];
            std::vector<double> near(profiles.size());
            for (std::size_t i = 0; i < profiles.size(); ++i)
                near[i] = distance(profiles[i], profiles[seed]);
            std::iota(order.begin(), order.end(), std::size_t(0));
            std::stable_sort(order.begin(), order.end(),
                             [&](std::size_t a, std::size_t b) { return near[a] < near[b]; });
            const std::size_t taken = std::min(likeFramesLimit, order.size());
            const Index parts = std::ssize(centre);
            for (Index cell = 0; cell < cells; ++cell) {
                const auto part = std::size_t(std::min(parts - 1, cell * parts / cells));
                double sum = 0.0;
                for (std::size_t i = 0; i < taken; ++i)
                    sum += double(profiles[order[i]][part]);
                result.colours.push_back(float(std::exp(sum / double(taken))));
            }
            for (std::size_t i = 0; i < profiles.size(); ++i)
                far[i] = k == 0 ? near[i] : std::min(far[i], near[i]);
        }
        return result;
    }

    /// Cells near steep changes of a colour, where smoothing would move the edge and flatten the leakage.
    void markEdges(const std::vector<float> &ln, std::vector<char> &isEdge)
    {
        const Index cells = std::ssize(ln);
        for (Index cell = 1; cell + 1 < cells; ++cell)
            if (std::abs(ln[std::size_t(cell + 1)] - ln[std::size_t(cell - 1)]) > steepLnPerTwoCells)
                std::fill(isEdge.begin() + std::max<Index>(0, cell - edgeReachCells),
                          isEdge.begin() + std::min(cells, cell + edgeReachCells + 1), 1);
    }

    void smoothColours(NoiseSources &sources, Index half)
    {
        const auto cells = std::size_t(sources.cells);
        std::vector<std::vector<float>> smooth;
        std::vector<char> isEdge(cells, 0);
        for (Index k = 0; k < sources.count(); ++k) {
            const float *colour = sources.colours.data() + k * sources.cells;
            std::vector<float> ln(cells);
            for (std::size_t cell = 0; cell < cells; ++cell)
                ln[cell] = std::log(std::max(colour[cell], lowestSourcePower));
            smooth.push_back(runningMedian(ln, half));
            markEdges(smooth.back(), isEdge);
        }
        for (Index k = 0; k < sources.count(); ++k) {
            float *colour = sources.colours.data() + k * sources.cells;
            for (std::size_t cell = 0; cell < cells; ++cell)
                if (!isEdge[cell])
                    colour[cell] = std::exp(smooth[std::size_t(k)][cell]);
        }
    }

} // namespace

void NoiseSources::addUp(std::span<const float> levels, std::span<float> out) const
{
    std::fill(out.begin(), out.end(), 0.0f);
    for (std::size_t k = 0; k < levels.size(); ++k)
        addSource(colours.data() + k * out.size(), levels[k], out.size(), out.data());
}

std::vector<float> NoiseSources::levelsIn(std::span<const float> frame) const
{
    std::vector<float> levels(std::size_t(count()), 0.0f);
    if (std::none_of(frame.begin(), frame.end(), [](float y) { return y > 0.0f; }))
        return levels;
    levels = firstLevels(*this, frame);
    UpdateScratch scratch(frame.size());
    for (int i = 0; i < sourceLevelUpdates; ++i)
        updateLevels(*this, frame, levels, scratch);
    return levels;
}

NoiseSources fitSources(std::span<const float> frames, Index cells, Index count, Index half)
{
    const auto size = std::size_t(cells);
    std::vector<float> loud; // frames without digital silence
    for (std::size_t first = 0; first < frames.size(); first += size)
        if (const auto row = frames.subspan(first, size);
            std::any_of(row.begin(), row.end(), [](float y) { return y > 0.0f; }))
            loud.insert(loud.end(), row.begin(), row.end());
    if (loud.empty())
        return {};
    NoiseSources sources = firstSources(loud, cells, count);
    const std::size_t frameCount = loud.size() / size;
    std::vector<std::vector<float>> levels;
    for (std::size_t frame = 0; frame < frameCount; ++frame)
        levels.push_back(firstLevels(sources, std::span(loud).subspan(frame * size, size)));
    UpdateScratch scratch(size);
    std::vector<float> pull(sources.colours.size());
    std::vector<float> inverse(sources.colours.size());
    for (int sweep = 0; sweep < sourceSweeps; ++sweep) {
        std::fill(pull.begin(), pull.end(), 0.0f);
        std::fill(inverse.begin(), inverse.end(), 0.0f);
        for (std::size_t frame = 0; frame < frameCount; ++frame) {
            const auto row = std::span<const float>(loud).subspan(frame * size, size);
            for (int i = 0; i < (sweep == 0 ? sourceLevelUpdates : 2); ++i)
                updateLevels(sources, row, levels[frame], scratch);
            weigh(sources, row, levels[frame], scratch);
            for (std::size_t k = 0; k < levels[frame].size(); ++k) {
                addSource(scratch.pull.data(), levels[frame][k], size, pull.data() + k * size);
                addSource(scratch.inverse.data(), levels[frame][k], size, inverse.data() + k * size);
            }
        }
        for (std::size_t i = 0; i < pull.size(); ++i)
            sources.colours[i] *= inverse[i] > 0.0f ? pull[i] / inverse[i] : 1.0f;
        smoothColours(sources, half);
    }
    return sources;
}

} // namespace faintline
