#pragma once

#include "spectrum/PeakPyramid.h"
#include "widgets/base/Span.h"

#include <optional>
#include <utility>
#include <vector>

namespace faintline {

/// Which values a picture's first and last colours stand for, dB or nat: set by hand, or as the pixels on the screen
/// suggest.
///
/// The pixels are counted for the whole picture at the zoom it is seen at, and zooms are told apart by powers of two in
/// frequency and of four in time: while one zooms, colours change now and then, not all along; while one scrolls, not
/// at all.
class ColourLevels
{
public:
    const Span &range() const { return m_range; }
    bool isAutomatic() const { return m_isAutomatic; }
    void setAutomatic(bool isAutomatic) { m_isAutomatic = isAutomatic; }
    void setRange(const Span &range) { m_range = range; }

    /// Number of pixels per byte of the picture's scale; nothing before the first count.
    const std::vector<double> &histogram() const { return m_histogram; }
    /// Counts where a pixel covers so many frames and cells; whether that was another zoom, or picture, than the last.
    bool count(const PeakPyramid &picture, double framesPerPixel, double cellsPerPixel);
    void countAgain() { m_key = {-1, 0}; } ///< next time, as the picture is another
    void clearHistogram() { m_histogram.clear(); }

    /// `automaticRange` of the pixels counted; the range as it is where none were.
    Span suggested(const ByteScale &scale, std::optional<double> threshold) const;
    /// Levels moved by hand: at least ½ apart. Of differences zero stays in the middle of the colours; the end that was
    /// moved takes the other one along.
    Span byHand(double low, double high, const ByteScale *scale) const;

private:
    Span m_range{-6.0, 14.0};
    bool m_isAutomatic = true;
    std::vector<double> m_histogram;
    std::pair<int, Index> m_key{-1, 0}; ///< level and cells per pixel it was counted at
};

} // namespace faintline
