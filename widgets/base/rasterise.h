#pragma once

#include "spectrum/PeakPyramid.h"
#include "widgets/base/Span.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// A row of pixels laid over a row of cells: pixel p covers first + p·step … first + (p+1)·step, where cell i covers i
/// … i+1. On a logarithmic scale it covers zero + e^(first + p·step) … zero + e^(first + (p+1)·step).
struct PixelRow {
    double first = 0.0;
    double step = 1.0;
    int count = 0;
    std::optional<double> zero{}; ///< of a logarithmic scale: where 0 Hz lies among the cells

    double cellCount() const { return zero ? std::exp(first + step * count) - std::exp(first) : step * count; }
    bool operator==(const PixelRow &) const = default;
};

/// The picture as bytes of its scale, time-major: `out` holds time.count × cells.count values.
///
///     pixel = max over n cells from the first one whose centre it covers, n = ⌈width of the pixel⌉
///
/// so that every pixel is the maximum of as many cells, which gives noise an even grain, and no maximum is lost, though
/// one near a pixel's edge may show in two. Zoomed in, every cell is a plain rectangle. In time the cells are rows of
/// the coarsest level that has at least one row, and where that is fast enough two, per pixel. Where `first` is a whole
/// number of steps, a pixel depends on that number, the step and the level alone, so that a part of a picture can be
/// drawn by itself. Large pictures are shared among threads; the bytes do not depend on that.
void rasterise(const PeakPyramid &picture, const PixelRow &time, const PixelRow &cells, std::span<std::uint8_t> out);

/// Where a picture's frames lie among those that the pixels are laid over; `first` is that of a row.
struct FramesWithin {
    Index first = 0;
    Index all = 0;
};

/// The same from rows of that level …
void rasterise(const PeakPyramid &picture, int level, const PixelRow &time, const PixelRow &cells,
               std::span<std::uint8_t> out, const FramesWithin &frames = {});
/// … which is this one for a whole picture.
int levelToRead(const PeakPyramid &picture, const PixelRow &time, const PixelRow &cells);

/// How many pixels bear each byte where a pixel covers so many frames and cells: from a sample of rows of the whole
/// picture, so it does not depend on where one looks. 256 counts.
std::vector<double> countPixels(const PeakPyramid &picture, double framesPerPixel, double cellsPerPixel);

/// Black and white level suggested by such counts: dB from somewhat under the noise's middle to 10 … 16 dB above it;
/// nats from the noise's middle to where only a detection gets; differences as far to either side of zero. Where lines
/// fill a band its middle is no longer the noise's: with a threshold given, what barely exceeds it keeps a colour of
/// its own.
Span automaticRange(const ByteScale &scale, const std::vector<double> &counts, std::optional<double> threshold = {});

/// What a box of whole cells holds.
struct BoxValues {
    double peak = 0.0;          ///< dB or nat
    std::optional<double> mean; ///< dB of the mean power; nothing for nats, or where frames have been merged
};

/// Of frames and cells begin … end-1, which must exist. Of very large boxes the peak is that of the rows of a coarser
/// level which touch the box.
BoxValues boxValues(const PeakPyramid &picture, Index beginFrame, Index endFrame, Index beginCell, Index endCell);

} // namespace faintline
