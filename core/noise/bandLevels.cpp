#include "noise/bandLevels.h"

#include "base/multiversion.h"
#include "noise/between.h"
#include "noise/constants.h"
#include "noise/levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace faintline {

namespace {

    /// First cell of a sub-band; column `bands` is the whole band.
    Index firstCell(Index column, Index bands, Index cells)
    {
        return column == bands ? 0 : column * cells / bands;
    }

    Index endCell(Index column, Index bands, Index cells)
    {
        return column == bands ? cells : (column + 1) * cells / bands;
    }

    /// ln of the true mean estimated by a mean of `cells` cells, corrected for the bias of the logarithm.
    float lnMean(float mean, std::ptrdiff_t cells, double likeness)
    {
        const double scatter = meanScatter(double(cells), likeness);
        return std::log(mean) + float(0.5 * scatter * scatter);
    }

    /// Replaces silence by the preceding level, or by the first known one.
    void bridgeSilence(std::vector<float> &series)
    {
        const auto first =
            std::find_if(series.begin(), series.end(), [](float value) { return value < levelNotKnown; });
        float level = first == series.end() ? 0.0f : *first;
        for (float &value : series)
            level = value = value < levelNotKnown ? value : level;
    }

    /// Cells first … end-1.
    struct RunOfCells {
        Index first;
        Index end;
    };

    /// The wanted ones of a range of cells.
    std::vector<RunOfCells> wantedCells(const std::vector<bool> &isWanted, RunOfCells range)
    {
        std::vector<RunOfCells> wanted;
        for (Index cell = range.first; cell < range.end; ++cell) {
            if (!isWanted[std::size_t(cell)])
                continue;
            if (wanted.empty() || wanted.back().end != cell)
                wanted.push_back({cell, cell});
            wanted.back().end = cell + 1;
        }
        return wanted;
    }

    Index countOf(const std::vector<RunOfCells> &ranges)
    {
        Index count = 0;
        for (const RunOfCells &range : ranges)
            count += range.end - range.first;
        return count;
    }

    FAINTLINE_MULTIVERSION
    void multiply(const float *a, const float *b, Index count, float *product)
    {
        for (Index i = 0; i < count; ++i)
            product[i] = a[i] * b[i];
    }

    /// Computes levels over a block's background, frame by frame.
    class FrameLevels
    {
    public:
        FrameLevels(const BlockBackground &block, Index bands, double likeness)
            : m_bands(bands), m_cells(std::ssize(block.lnPower)), m_likeness(likeness),
              m_agreeing(float(4.0 * medianScatter(double(m_cells) / double(bands)))), m_inverse(std::size_t(m_cells)),
              m_medians(std::size_t(bands), std::numbers::ln2_v<float>), m_products(std::size_t(m_cells))
        {
            for (std::size_t cell = 0; cell < m_inverse.size(); ++cell)
                m_inverse[cell] =
                    block.lnPower[cell] > NoiseBackground::silence ? std::exp(-block.lnPower[cell]) : 0.0f;
            for (Index band = 0; band < bands; ++band) {
                const RunOfCells range{firstCell(band, bands, m_cells), endCell(band, bands, m_cells)};
                m_noise.push_back(wantedCells(block.isNoise, range));
                m_firm.push_back(wantedCells(block.isFirm, range));
                m_isMostlyFirm.push_back(2 * countOf(m_firm.back()) >= range.end - range.first);
            }
        }

        /// Levels of each sub-band, and last of the whole band.
        void read(std::span<const float> frame, std::span<float> levels)
        {
            levelsOfBands(frame, levels);
            const bool isFirm = 2 * std::ssize(m_telling) >= m_bands || m_known.size() == m_telling.size();
            if (!isFirm) // a few sub-bands do not represent the whole band
                m_telling = m_known;
            std::vector<float> told;
            for (const Index band : m_telling)
                told.push_back(levels[std::size_t(band)]);
            const float middle = middleOf(told);
            m_count = 0;
            for (Index band : m_telling)
                if (m_telling.size() < 3 || std::abs(levels[std::size_t(band)] - middle) < m_agreeing)
                    collect(frame, isFirm ? m_firm[std::size_t(band)] : m_noise[std::size_t(band)]);
            const float mean = truncatedMean(sample(), std::exp(middle));
            levels.back() = mean > 0.0f && m_count > 0 ? lnMean(mean, m_count, m_likeness) : levelNotKnown;
            std::replace(levels.begin(), levels.end() - 1, levelNotKnown, levels.back());
        }

    private:
        /// Levels of the sub-bands, the known ones, and those that represent the whole band.
        void levelsOfBands(std::span<const float> frame, std::span<float> levels)
        {
            m_telling.clear();
            m_known.clear();
            for (Index band = 0; band < m_bands; ++band) {
                m_count = 0;
                collect(frame, m_noise[std::size_t(band)]);
                if (m_count < fewestBandCells)
                    continue;
                const float median = exponentialMedian(sample(), m_medians[std::size_t(band)]);
                if (!(median > 0.0f))
                    continue;
                m_medians[std::size_t(band)] = median;
                levels[std::size_t(band)] =
                    lnMean(truncatedMean(sample(), median / std::numbers::ln2_v<float>), m_count, m_likeness);
                m_known.push_back(band);
                if (m_isMostlyFirm[std::size_t(band)])
                    m_telling.push_back(band);
            }
        }

        /// Adds the frame over the background in those cells to the sample.
        void collect(std::span<const float> frame, const std::vector<RunOfCells> &wanted)
        {
            for (const auto &[first, end] : wanted) {
                multiply(frame.data() + first, m_inverse.data() + first, end - first, m_products.data() + m_count);
                m_count += end - first;
            }
        }

        std::span<const float> sample() const { return std::span(m_products).first(std::size_t(m_count)); }

        /// Median; two values have no majority, so all count.
        static float middleOf(std::vector<float> &levels)
        {
            if (levels.size() > 2)
                return medianOf(levels);
            return levels.empty() ? 0.0f : std::accumulate(levels.begin(), levels.end(), 0.0f) / float(levels.size());
        }

        Index m_bands;
        Index m_cells;
        double m_likeness;
        float m_agreeing; ///< maximum distance of a sub-band's level from the median one
        std::vector<float> m_inverse;
        std::vector<std::vector<RunOfCells>> m_noise; ///< cells of noise in each sub-band
        std::vector<std::vector<RunOfCells>> m_firm;  ///< those whose background is firm
        std::vector<bool> m_isMostlyFirm;             ///< each sub-band
        std::vector<float> m_medians;                 ///< of each sub-band in the frame before
        std::vector<float> m_products;                ///< begins with the sample
        Index m_count = 0;                            ///< cells of the sample
        std::vector<Index> m_telling;
        std::vector<Index> m_known;
    };

} // namespace

std::vector<float> levelsOf(std::span<const float> frames, const BlockBackground &block, Index bands, double likeness)
{
    if (bands == 0)
        return {};
    const auto cells = block.lnPower.size();
    const std::size_t count = frames.size() / cells;
    const auto columns = std::size_t(bands + 1);
    std::vector<float> levels(count * columns, levelNotKnown);
    FrameLevels levelsIn(block, bands, likeness);
    for (std::size_t frame = 0; frame < count; ++frame)
        levelsIn.read(frames.subspan(frame * cells, cells), std::span(levels).subspan(frame * columns, columns));
    return levels;
}

std::vector<float> mediansOf(const std::vector<float> &levels, Index columns)
{
    std::vector<float> medians(std::size_t(columns), 0.0f);
    std::vector<float> series;
    for (std::size_t column = 0; column < medians.size(); ++column) {
        series.clear();
        for (std::size_t i = column; i < levels.size(); i += medians.size())
            if (levels[i] < levelNotKnown)
                series.push_back(levels[i]);
        if (!series.empty())
            medians[column] = medianOf(series);
    }
    return medians;
}

float shareOfLines(float median)
{
    return std::clamp(median - medianChanceLn, 0.0f, lineShareLimitLn);
}

LevelOffsets::LevelOffsets(const std::vector<float> &levels, Index columns)
    : medians(mediansOf(levels, columns)), isSure(medians.size(), false)
{
    std::vector<float> deviations = levels;
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (levels[i] < levelNotKnown)
            deviations[i] = std::abs(levels[i] - medians[i % medians.size()]);
    const std::vector<float> typical = mediansOf(deviations, columns);
    for (std::size_t column = 0; column < medians.size(); ++column)
        isSure[column] = std::ssize(levels) > 7 * columns && std::abs(medians[column]) >= 1.4826f * typical[column];
}

void removeOffsets(std::vector<float> &levels, const std::vector<LevelOffsets> &offsets,
                   const std::vector<Index> &blockOfLevel)
{
    if (offsets.empty())
        return;
    const std::size_t columns = offsets.front().medians.size();
    std::vector<std::vector<float>> taken;
    std::vector<float> few;
    for (Index block = 0; block < std::ssize(offsets); ++block) {
        const LevelOffsets &own = offsets[std::size_t(block)];
        taken.push_back(std::vector<float>(columns, 0.0f));
        for (std::size_t column = 0; column < columns; ++column) {
            if (own.isSure[column]) {
                taken.back()[column] = own.medians[column];
                continue;
            }
            if (column + 1 == columns)
                continue;
            few.clear();
            for (Index other = std::max<Index>(0, block - steadyBlocks);
                 other <= std::min(std::ssize(offsets) - 1, block + steadyBlocks); ++other)
                if (const LevelOffsets &each = offsets[std::size_t(other)]; !each.isSure[column])
                    few.push_back(each.medians[column]);
            taken.back()[column] = shareOfLines(medianOf(few));
        }
    }
    for (std::size_t i = 0; i < levels.size(); ++i)
        if (levels[i] < levelNotKnown)
            levels[i] -= taken[std::size_t(blockOfLevel[i / columns])][i % columns];
}

std::vector<double> meanOver(const float *upper, const float *lower, std::vector<bool>::const_iterator isNoise,
                             Index cells, Index bands)
{
    std::vector<double> result(std::size_t(bands + 1), 0.0);
    std::vector<double> counts(result.size(), 0.0);
    for (Index band = 0; band < bands; ++band)
        for (Index cell = firstCell(band, bands, cells); cell < endCell(band, bands, cells); ++cell)
            if (isNoise[cell]) {
                result[std::size_t(band)] += double(upper[cell] - lower[cell]);
                counts[std::size_t(band)] += 1.0;
            }
    result.back() = std::accumulate(result.begin(), result.end(), 0.0);
    counts.back() = std::accumulate(counts.begin(), counts.end(), 0.0);
    for (std::size_t column = 0; column < result.size(); ++column)
        result[column] = counts[column] > 0.0 ? result[column] / counts[column] : 0.0;
    for (std::size_t column = 0; column < result.size(); ++column)
        if (counts[column] == 0.0) // uses the common level
            result[column] = result.back();
    return result;
}

void moveToBackground(std::vector<float> &levels, const BlockRows &rows, const NoiseBackground &background,
                      const std::vector<Index> &blockOfLevel)
{
    const Index columns = background.bandCount + 1;
    const Index cells = background.frequency.count;
    const Index last = background.time.count - 1;
    std::array<std::vector<double>, 3> over; // the previous block, its own, the next
    Index known = -1;
    for (Index i = 0; i < background.levelTime.count; ++i) {
        const Index block = blockOfLevel[std::size_t(i)];
        const float *own = rows.lnPower.data() + block * cells;
        if (block != known)
            for (Index side = -1; side <= 1; ++side)
                over[std::size_t(side + 1)] =
                    meanOver(own, background.lnPower.data() + std::clamp<Index>(block + side, 0, last) * cells,
                             rows.isNoise.begin() + block * cells, cells, background.bandCount);
        known = block;
        if (own[0] <= NoiseBackground::silence)
            continue;
        const Between t = between(background.time, background.levelTime.value(double(i)));
        const auto isSilent = [&](Index b) {
            return background.lnPower[std::size_t(std::min(b, last) * cells)] <= NoiseBackground::silence;
        };
        const Index early = isSilent(t.lower) ? t.lower + 1 : t.lower;
        const Index late = isSilent(t.lower + 1) ? t.lower : t.lower + 1;
        for (Index column = 0; column < columns; ++column) {
            const auto difference = [&](Index b) {
                return over[std::size_t(std::clamp<Index>(std::min(b, last) - block + 1, 0, 2))][std::size_t(column)];
            };
            float &level = levels[std::size_t(i * columns + column)];
            if (level < levelNotKnown)
                level += float((1.0 - t.fraction) * difference(early) + t.fraction * difference(late));
        }
    }
}

std::vector<float> finishLevels(const std::vector<float> &levels, const NoiseBackground &background, double overlap,
                                double likeness)
{
    const auto bands = std::size_t(background.bandCount);
    const auto count = std::size_t(background.levelTime.count);
    std::vector<float> result(count * bands);
    if (bands == 0)
        return result;
    const auto cells = double(background.frequency.count);
    const auto column = [&](std::size_t number) {
        std::vector<float> series(count);
        for (std::size_t i = 0; i < count; ++i)
            series[i] = levels[i * (bands + 1) + number];
        bridgeSilence(series);
        return series;
    };
    const std::vector<float> common = beyondScatter(column(bands), overlap * meanScatter(cells, likeness));
    for (std::size_t band = 0; band < bands; ++band) {
        std::vector<float> own = column(band);
        for (std::size_t i = 0; i < count; ++i)
            own[i] -= common[i];
        own = beyondScatter(own, overlap * meanScatter(cells / double(bands), likeness));
        for (std::size_t i = 0; i < count; ++i)
            result[i * bands + band] = common[i] + own[i];
    }
    return result;
}

} // namespace faintline
