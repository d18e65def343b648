#include "noise/unevenness.h"

#include "noise/NoiseBackground.h"
#include "noise/bandLevels.h"
#include "noise/constants.h"

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

} // namespace

Unevenness unevenness(std::span<const float> frames, const std::vector<float> &ofCell,
                      const std::vector<float> &ofFrame)
{
    const Index cells = std::ssize(ofCell);
    Unevenness result;
    for (Index cell = 0; cell + Unevenness::tileCells <= cells; cell += Unevenness::tileCells) {
        double sum = 0.0;
        double squares = 0.0;
        double sumOfMeans = 0.0;
        double squaresOfMeans = 0.0;
        double count = 0.0;
        for (Index first = 0; first + Unevenness::tileFrames <= std::ssize(ofFrame); first += Unevenness::tileFrames) {
            double mean = 0.0;
            for (Index frame = first; frame < first + Unevenness::tileFrames; ++frame) {
                const float *row = frames.data() + frame * cells;
                const float factor = ofFrame[std::size_t(frame)];
                for (Index i = cell; i < cell + Unevenness::tileCells; ++i)
                    mean += double(std::min(row[i] * factor * ofCell[std::size_t(i)], lineLimit));
            }
            if (mean <= 0.0)
                continue;
            mean /= double(Unevenness::tileFrames * Unevenness::tileCells);
            const double ln = std::log(mean);
            sum += ln;
            squares += ln * ln;
            sumOfMeans += mean;
            squaresOfMeans += mean * mean;
            count += 1.0;
        }
        if (count < 2.0)
            continue;
        result.sum += squares - sum * sum / count;
        result.sumOfMeans += squaresOfMeans - sumOfMeans * sumOfMeans / count;
        result.freedom += count - 1.0;
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
