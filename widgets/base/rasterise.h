#pragma once

#include "frames/PeakPyramid.h"
#include "widgets/base/Span.h"

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace faintline {

/// A row of pixels over a row of cells: pixel p covers first + p·step … first + (p+1)·step, and cell i covers i … i+1.
/// On a logarithmic scale pixel p covers zero + e^(first + p·step) … zero + e^(first + (p+1)·step).
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
/// so that every pixel is the maximum of the same number of cells, which gives noise an even grain, and no maximum is
/// lost, although one near a pixel's edge may appear in two. When zoomed in, every cell is a plain rectangle. In time
/// the cells are rows of the coarsest level that has at least one row per pixel, or two if that is fast enough. If
/// `first` is a multiple of the step, a pixel depends only on that multiple, the step and the level, so that a part of
/// a picture can be drawn alone. Large pictures are processed by several threads; the bytes do not depend on that.
void rasterise(const PeakPyramid &picture, const PixelRow &time, const PixelRow &cells, std::span<std::uint8_t> out);

/// Position of a picture's frames among those covered by the pixels; `first` is the first frame of a row.
struct FramesWithin {
    Index first = 0;
    Index all = 0;
};

/// The same from rows of the given level …
void rasterise(const PeakPyramid &picture, int level, const PixelRow &time, const PixelRow &cells,
               std::span<std::uint8_t> out, const FramesWithin &frames = {});
/// … which is this one for a whole picture.
int levelToRead(const PeakPyramid &picture, const PixelRow &time, const PixelRow &cells);

/// Number of pixels with each byte if a pixel covers the given number of frames and cells: from a sample of rows of the
/// whole picture, so independent of the visible part. 256 counts.
std::vector<double> countPixels(const PeakPyramid &picture, double framesPerPixel, double cellsPerPixel);

/// Suggested black and white level for such counts: dB from slightly below the noise's median to 10 … 16 dB above it;
/// nats from the noise's median to values reached only by detections; differences symmetric about zero. With a given
/// threshold, from the noise's median or half the threshold, which is smaller, to nearly the strongest of what exceeds
/// the threshold, and at least to one and a half thresholds; ColourScale keeps values near the threshold apart.
Span automaticRange(const ByteScale &scale, const std::vector<double> &counts, std::optional<double> threshold = {});

/// The same for levels of noise that differs from cell to cell: nearly all of them.
Span rangeOfLevels(const ByteScale &scale, const std::vector<double> &counts);

/// Peak and mean of a box of whole cells.
struct BoxValues {
    double peak = 0.0;          ///< dB or nat
    std::optional<double> mean; ///< dB of the mean power; nothing for nats, or where frames have been merged
};

/// For frames and cells begin … end-1, which must exist. For very large boxes the peak is that of the rows of a coarser
/// level that intersect the box.
BoxValues boxValues(const PeakPyramid &picture, Index beginFrame, Index endFrame, Index beginCell, Index endCell);

} // namespace faintline
