#include "evaluate/comparison/differencePicture.h"

#include "base/memoryShares.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace faintline {

namespace {

    constexpr double rarityLimitNats = 700.0; ///< nat; smaller probabilities underflow in double precision

    bool isInNats(const Analysis &analysis)
    {
        return detectorUnits[analysis.settings.detector.index()] == "nat";
    }

    /// m(D) for each byte value of a statistic's picture.
    std::array<float, 256> margins(const Analysis &analysis, bool isPlain)
    {
        const auto rarity = [&](double statistic) {
            return std::min(-std::log(analysis.calibration->exceedanceAt(statistic)), rarityLimitNats);
        };
        std::array<float, 256> result{};
        for (int byte = 0; byte < 256; ++byte) {
            const double statistic = analysis.statistic->scale().value(byte);
            result[std::size_t(byte)] =
                float(isPlain ? statistic - analysis.threshold : rarity(statistic) - rarity(analysis.threshold));
        }
        return result;
    }

    struct CellRange {
        Index begin = 0;
        Index end = 0;
    };

    /// For each cell of `to`, the cells of `from` whose centres lie in it, or the nearest one.
    std::vector<CellRange> cellsWithin(const Axis &from, const Axis &to)
    {
        std::vector<CellRange> ranges;
        for (Index i = 0; i < to.count; ++i) {
            const double low = from.position(to.value(double(i) - 0.5));
            const double high = from.position(to.value(double(i) + 0.5));
            CellRange range{Index(std::ceil(low - 1e-9)), Index(std::ceil(high - 1e-9))};
            range = {std::clamp<Index>(range.begin, 0, from.count), std::clamp<Index>(range.end, 0, from.count)};
            if (range.begin >= range.end) {
                const Index nearest = std::clamp<Index>(std::llround(0.5 * (low + high)), 0, from.count - 1);
                range = {nearest, nearest + 1};
            }
            ranges.push_back(range);
        }
        return ranges;
    }

    /// Time axis of a picture's rows.
    Axis rowsOf(const PeakPyramid &picture)
    {
        const auto frames = double(picture.framesPerRow(0));
        const Axis &time = picture.time();
        return {time.name, time.unit, time.value(0.5 * (frames - 1.0)), frames * time.step, picture.rowCount(0), false};
    }

    void raise(std::span<std::uint8_t> to, std::span<const std::uint8_t> from)
    {
        for (std::size_t i = 0; i < to.size(); ++i)
            to[i] = std::max(to[i], from[i]);
    }

} // namespace

bool haveCommonUnit(const Analysis &a, const Analysis &b)
{
    return isInNats(a) && isInNats(b);
}

std::shared_ptr<const PeakPyramid> differencePicture(const Analysis &a, const Analysis &b, const RunContext &context)
{
    if (!a.grid().isSpectrum() || !b.grid().isSpectrum())
        return nullptr;
    const bool isPlain = haveCommonUnit(a, b);
    const auto marginsA = margins(a, isPlain);
    const auto marginsB = margins(b, isPlain);
    const Axis rowsA = rowsOf(*a.statistic);
    const Axis rowsB = rowsOf(*b.statistic);
    const auto cells = cellsWithin(a.grid().axes.front(), b.grid().axes.front());
    const auto rows = cellsWithin(rowsA, rowsB);

    const auto result = std::make_shared<PeakPyramid>(
        rowsB, b.grid().size(), ByteScale(ByteScale::Kind::DifferenceNats), memoryShares::picture);
    std::vector<std::uint8_t> highest;
    std::vector<float> difference(std::size_t(b.grid().size()));
    for (Index row = 0; row < rowsB.count; ++row) {
        if (row % 256 == 0)
            context.checkpoint(double(row) / double(rowsB.count), "comparing");
        const CellRange range = rows[std::size_t(row)];
        const auto first = a.statistic->row(0, range.begin);
        highest.assign(first.begin(), first.end());
        for (Index other = range.begin + 1; other < range.end; ++other)
            raise(highest, a.statistic->row(0, other));
        const auto own = b.statistic->row(0, row);
        for (std::size_t cell = 0; cell < difference.size(); ++cell) {
            const CellRange within = cells[cell];
            const std::uint8_t best = *std::max_element(highest.begin() + within.begin, highest.begin() + within.end);
            difference[cell] = marginsB[own[cell]] - marginsA[best];
        }
        result->append(difference);
    }
    result->finish();
    return result;
}

} // namespace faintline
