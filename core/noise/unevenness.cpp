#include "noise/unevenness.h"

#include "noise/NoiseBackground.h"
#include "noise/bandLevels.h"
#include "noise/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    /// Over the tiles of the same cells.
    struct TileSums {
        double ln = 0.0;
        double lnSquares = 0.0;
        double means = 0.0;
        double meanSquares = 0.0;
        double count = 0.0;

        void add(double mean)
        {
            const double lnMean = std::log(mean);
            ln += lnMean;
            lnSquares += lnMean * lnMean;
            means += mean;
            meanSquares += mean * mean;
            count += 1.0;
        }
    };

} // namespace

Unevenness unevenness(std::span<const float> frames, const std::vector<float> &ofCell,
                      const std::vector<float> &ofFrame)
{
    const auto cells = ofCell.size();
    std::vector<TileSums> sums(cells / std::size_t(Unevenness::tileCells));
    std::vector<double> tiles(sums.size());
    // Frame by frame, as they lie in memory, and so that sums of several tiles are under way at the same time.
    for (Index first = 0; first + Unevenness::tileFrames <= std::ssize(ofFrame); first += Unevenness::tileFrames) {
        std::ranges::fill(tiles, 0.0);
        for (Index frame = first; frame < first + Unevenness::tileFrames; ++frame) {
            const float *row = frames.data() + std::size_t(frame) * cells;
            const float factor = ofFrame[std::size_t(frame)];
            for (std::size_t tile = 0; tile < tiles.size(); ++tile) {
                const std::size_t cell = tile * Unevenness::tileCells;
                for (std::size_t i = cell; i < cell + Unevenness::tileCells; ++i)
                    tiles[tile] += double(std::min(row[i] * factor * ofCell[i], lineLimit));
            }
        }
        for (std::size_t tile = 0; tile < tiles.size(); ++tile)
            if (tiles[tile] > 0.0)
                sums[tile].add(tiles[tile] / double(Unevenness::tileFrames * Unevenness::tileCells));
    }
    Unevenness result;
    for (const TileSums &each : sums) {
        if (each.count < 2.0)
            continue;
        result.sum += each.lnSquares - each.ln * each.ln / each.count;
        result.sumOfMeans += each.meanSquares - each.means * each.means / each.count;
        result.freedom += each.count - 1.0;
    }
    return result;
}

Unevenness changesOf(const std::vector<float> &frames, const BlockBackground &block, const std::vector<float> &levels,
                     Index bands)
{
    std::vector<float> ofCell;
    for (const float ln : block.lnPower)
        ofCell.push_back(ln > NoiseBackground::silence ? std::exp(-ln) : 0.0f);
    std::vector<float> ofFrame;
    for (std::size_t i = std::size_t(bands); i < levels.size(); i += std::size_t(bands + 1))
        ofFrame.push_back(levels[i] < levelNotKnown ? std::exp(-levels[i]) : 0.0f);
    return unevenness(frames, ofCell, ofFrame);
}

} // namespace faintline
