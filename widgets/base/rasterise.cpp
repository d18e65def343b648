#include "widgets/base/rasterise.h"

#include "base/logmath.h"
#include "base/multiversion.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <thread>

namespace faintline {

namespace {

    struct Range {
        Index begin = 0;
        Index end = 0;
    };

    /// The items of a pixel.
    Range itemsOf(double low, double width, Index itemCount)
    {
        const auto count = Index(std::ceil(width - 1e-6));
        const double first = width > 1.0 ? std::ceil(low - 0.5 - 1e-6) : std::floor(low + 0.5 * width);
        const Index begin = std::clamp<Index>(Index(first), 0, std::max<Index>(itemCount - count, 0));
        return {begin, std::min(begin + count, itemCount)};
    }

    /// The items (cells, or rows of `size` frames) of each pixel.
    std::vector<Range> itemsOfPixels(const PixelRow &pixels, double size, Index itemCount)
    {
        std::vector<Range> ranges(std::size_t(pixels.count));
        if (pixels.zero) {
            for (int p = 0; p < pixels.count; ++p) {
                const double low = std::exp(pixels.first + p * pixels.step);
                const double width = low * std::expm1(pixels.step);
                ranges[std::size_t(p)] = itemsOf((*pixels.zero + low) / size, width / size, itemCount);
            }
            return ranges;
        }
        const double step = pixels.step / size;
        // On a grid that starts with the axis, a pixel's cells depend only on its number in the grid.
        double number = pixels.first / pixels.step;
        if (std::abs(number - std::round(number)) < 1e-6)
            number = std::round(number);
        for (int p = 0; p < pixels.count; ++p)
            ranges[std::size_t(p)] = itemsOf((number + p) * step, step, itemCount);
        return ranges;
    }

    FAINTLINE_MULTIVERSION
    void raise(std::uint8_t *to, const std::uint8_t *from, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i)
            to[i] = std::max(to[i], from[i]);
    }

    FAINTLINE_MULTIVERSION
    void higherOf(const std::uint8_t *a, const std::uint8_t *b, std::uint8_t *to, std::size_t count)
    {
        for (std::size_t i = 0; i < count; ++i)
            to[i] = std::max(a[i], b[i]);
    }

    std::uint8_t highest(const std::uint8_t *from, Index count)
    {
        std::uint8_t high = 0;
        for (Index i = 0; i < count; ++i)
            high = std::max(high, from[i]);
        return high;
    }

    /// The maximum of each pixel's cells. If all pixels have the same number of cells: from maxima over 2, 4, 8 … cells
    /// of the whole line, it combines the largest ones at either end of the pixel.
    class LineMaxima
    {
    public:
        LineMaxima(std::size_t width, bool areAlike) : m_areAlike(areAlike), m_one(width), m_other(width) {}

        void draw(const std::uint8_t *values, std::size_t lowest, const std::vector<Range> &cellsOfPixel,
                  std::uint8_t *line)
        {
            if (!m_areAlike) {
                for (const Range &range : cellsOfPixel)
                    *line++ = highest(values + std::size_t(range.begin) - lowest, range.end - range.begin);
                return;
            }
            const auto cells = std::size_t(cellsOfPixel.front().end - cellsOfPixel.front().begin);
            std::size_t stretch = 1;
            for (; 2 * stretch <= cells; stretch *= 2) {
                higherOf(values, values + stretch, m_one.data(), m_one.size() - 2 * stretch + 1);
                values = m_one.data();
                std::swap(m_one, m_other);
            }
            for (std::size_t i = 0; i < cellsOfPixel.size(); ++i) {
                const std::size_t begin = std::size_t(cellsOfPixel[i].begin) - lowest;
                line[i] = std::max(values[begin], values[begin + cells - stretch]);
            }
        }

    private:
        bool m_areAlike;
        std::vector<std::uint8_t> m_one;
        std::vector<std::uint8_t> m_other;
    };

    double quantile(const ByteScale &scale, const std::vector<double> &counts, double share)
    {
        // The lowest byte is silence or "never reached", not noise.
        const double total = std::accumulate(counts.begin() + 1, counts.end(), 0.0);
        double sum = 0.0;
        for (int byte = 1; byte < 256; ++byte) {
            sum += counts[std::size_t(byte)];
            if (sum >= share * total)
                return scale.value(byte);
        }
        return scale.value(255);
    }

    /// Black and white level of differences: symmetric about zero, excluding only the strongest.
    Span rangeOfDifferences(const ByteScale &scale, const std::vector<double> &counts)
    {
        constexpr double smallest = 6.0, largest = 40.0;
        const double total = std::accumulate(counts.begin(), counts.end(), 0.0);
        double sum = 0.0;
        double magnitude = 0.0;
        for (int byte = 0; byte < 256 && sum < 0.998 * total; ++byte) {
            sum += counts[std::size_t(byte)];
            magnitude = std::abs(scale.value(byte));
        }
        const double half = std::clamp(std::ceil(magnitude), smallest, largest);
        return {-half, half};
    }

} // namespace

int levelToRead(const PeakPyramid &picture, const PixelRow &time, const PixelRow &cells)
{
    // Reading twice as many rows gives a sharper picture, but takes too long for a hundred thousand cells.
    constexpr double affordableBytes = 48e6;
    const bool isAffordable = 8.0 * time.count * cells.cellCount() < affordableBytes;
    return picture.levelFor(std::max(isAffordable ? 0.5 * time.step : time.step, 1.0));
}

void rasterise(const PeakPyramid &picture, const PixelRow &time, const PixelRow &cells, std::span<std::uint8_t> out)
{
    rasterise(picture, levelToRead(picture, time, cells), time, cells, out);
}

void rasterise(const PeakPyramid &picture, int level, const PixelRow &time, const PixelRow &cells,
               std::span<std::uint8_t> out, const FramesWithin &frames)
{
    const Index rowCount = picture.rowCount(level);
    if (rowCount == 0 || picture.cells() == 0) {
        std::fill(out.begin(), out.end(), std::uint8_t(0));
        return;
    }
    // Future rows of a picture in progress are empty.
    const Index perRow = picture.framesPerRow(level);
    const Index firstRow = frames.first / perRow;
    const Index wholeCount =
        std::max(firstRow + rowCount, (std::max(frames.all, picture.time().count) + perRow - 1) / perRow);
    auto rowsOfPixel = itemsOfPixels(time, double(perRow), wholeCount);
    for (Range &rows : rowsOfPixel)
        rows = {rows.end > firstRow ? std::max<Index>(rows.begin - firstRow, 0) : -1, rows.end - firstRow};
    const auto cellsOfPixel = itemsOfPixels(cells, 1.0, picture.cells());
    const auto lowest = std::size_t(cellsOfPixel.front().begin);
    const auto width = std::size_t(cellsOfPixel.back().end) - lowest;

    const auto drawLines = [&](Index begin, Index end) {
        std::vector<std::uint8_t> merged(width);
        LineMaxima maxima(width, !cells.zero);
        Range done;
        for (Index p = begin; p < end; ++p) {
            std::uint8_t *line = out.data() + std::size_t(p) * cellsOfPixel.size();
            const Range rows = rowsOfPixel[std::size_t(p)];
            if (p > begin && rows.begin == done.begin && rows.end == done.end) {
                std::copy_n(line - cellsOfPixel.size(), cellsOfPixel.size(), line);
                continue;
            }
            done = rows;
            if (rows.begin < 0 || rows.begin >= rowCount) {
                std::fill_n(line, cellsOfPixel.size(), std::uint8_t(0));
                continue;
            }
            const std::uint8_t *values = picture.row(level, rows.begin).data() + lowest;
            if (rows.end - rows.begin > 1) {
                std::copy_n(values, width, merged.data());
                for (Index r = rows.begin + 1; r < std::min(rows.end, rowCount); ++r)
                    raise(merged.data(), picture.row(level, r).data() + lowest, width);
                values = merged.data();
            }
            maxima.draw(values, lowest, cellsOfPixel, line);
        }
    };

    constexpr double bytesWorthAThread = 2e6;
    const double bytes = std::max(time.step / double(perRow), 1.0) * time.count * double(width);
    RunContext context;
    const auto processors = double(std::thread::hardware_concurrency());
    context.threads = int(std::min({bytes / bytesWorthAThread, processors, 8.0}));
    if (context.threads < 2)
        return drawLines(0, time.count);
    const Index bands = 4 * context.threads;
    parallelFor(bands, context, {}, [&] {
        return [&](Index band) { drawLines(band * time.count / bands, (band + 1) * time.count / bands); };
    });
}

std::vector<double> countPixels(const PeakPyramid &picture, double framesPerPixel, double cellsPerPixel)
{
    std::vector<double> counts(256, 0.0);
    const int level = picture.levelFor(std::max(framesPerPixel, 1.0));
    const Index rowCount = picture.rowCount(level);
    if (rowCount == 0 || picture.cells() == 0)
        return counts;
    const Index cellsPerGroup = std::clamp<Index>(Index(std::lround(cellsPerPixel)), 1, picture.cells());
    constexpr Index cellLimit = 2'000'000;
    const Index stride = std::max<Index>(rowCount * picture.cells() / cellLimit, 1);
    for (Index row = 0; row < rowCount; row += stride) {
        const auto values = picture.row(level, row);
        for (Index cell = 0; cell < picture.cells(); cell += cellsPerGroup) {
            const Index count = std::min(cellsPerGroup, picture.cells() - cell);
            counts[highest(values.data() + cell, count)] += double(stride);
        }
    }
    return counts;
}

BoxValues boxValues(const PeakPyramid &picture, Index beginFrame, Index endFrame, Index beginCell, Index endCell)
{
    constexpr double affordableCells = 4e6;
    const auto frames = double(endFrame - beginFrame);
    const int level = picture.levelFor(frames * double(endCell - beginCell) / affordableCells);
    const Index perRow = picture.framesPerRow(level);
    const Index endRow = std::min((endFrame + perRow - 1) / perRow, picture.rowCount(level));
    std::vector<double> counts(256, 0.0);
    for (Index row = beginFrame / perRow; row < endRow; ++row)
        for (Index cell = beginCell; cell < endCell; ++cell)
            counts[picture.row(level, row)[std::size_t(cell)]] += 1.0;

    BoxValues values;
    double power = 0.0, count = 0.0;
    for (int byte = 0; byte < 256; ++byte) {
        const double here = counts[std::size_t(byte)];
        if (here > 0.0)
            values.peak = picture.scale().value(byte);
        power += here * ratioFromDb(picture.scale().value(byte));
        count += here;
    }
    if (picture.scale().kind() == ByteScale::Kind::PowerDb && perRow == 1 && count > 0.0)
        values.mean = dbFromRatio(power / count);
    return values;
}

Span rangeOfLevels(const ByteScale &scale, const std::vector<double> &counts)
{
    const double low = quantile(scale, counts, 0.05);
    return {low, std::max(quantile(scale, counts, 0.98) + 2.0, low + 10.0)};
}

Span automaticRange(const ByteScale &scale, const std::vector<double> &counts, std::optional<double> threshold)
{
    if (scale.kind() == ByteScale::Kind::DifferenceNats)
        return rangeOfDifferences(scale, counts);
    if (std::accumulate(counts.begin() + (counts.empty() ? 0 : 1), counts.end(), 0.0) == 0.0)
        return scale.kind() == ByteScale::Kind::PowerDb ? Span{-6.0, 14.0} : Span{0.0, 30.0};
    const double middle = quantile(scale, counts, 0.5);
    if (scale.kind() == ByteScale::Kind::PowerDb) {
        return {middle - 2.5, std::clamp(quantile(scale, counts, 0.998) + 2.0, middle + 10.0, middle + 16.0)};
    }
    if (!threshold || *threshold <= 0.0) {
        // The noise's tail is exponential, so a multiple of the upper quartile's distance is a false-alarm probability.
        const double tail = std::max(quantile(scale, counts, 0.75) - middle, 0.25);
        return {middle, middle + std::clamp(25.0 * tail, 10.0, 200.0)};
    }
    constexpr double leastThresholds = 1.5; // noise alone stays dark
    constexpr double nearlyAll = 0.98;      // of the pixels above the threshold
    const double low = std::min(middle, 0.5 * *threshold);
    std::vector<double> above = counts;
    for (int byte = 0; byte < 256; ++byte)
        if (scale.value(byte) <= *threshold)
            above[std::size_t(byte)] = 0.0;
    const bool hasDetections = std::accumulate(above.begin(), above.end(), 0.0) > 0.0;
    const double strongest = hasDetections ? quantile(scale, above, nearlyAll) : 0.0;
    return {low, std::max({strongest, leastThresholds * *threshold, low + 10.0})};
}

} // namespace faintline
