#pragma once

#include "frames/PeakPyramid.h"
#include "widgets/base/Span.h"

#include <optional>
#include <utility>
#include <vector>

namespace faintline {

/// The values of a picture's first and last colours, dB or nat: set by hand, or suggested by the displayed pixels.
///
/// The pixels are counted for the whole picture at the current zoom. Zoom levels differ by powers of two in frequency
/// and of four in time, so that colours change only occasionally while zooming, and not at all while scrolling.
class ColourLevels
{
public:
    const Span &range() const { return m_range; }
    bool isAutomatic() const { return m_isAutomatic; }
    void setAutomatic(bool isAutomatic) { m_isAutomatic = isAutomatic; }
    void setRange(const Span &range) { m_range = range; }

    /// Number of pixels per byte of the picture's scale; nothing before the first count.
    const std::vector<double> &histogram() const { return m_histogram; }
    /// Counts pixels that cover the given number of frames and cells; returns whether zoom level or picture differ from
    /// the last count.
    bool count(const PeakPyramid &picture, double framesPerPixel, double cellsPerPixel);
    void countAgain() { m_key = {-1, 0}; } ///< forces a count of a new picture
    void clearHistogram() { m_histogram.clear(); }

    /// `automaticRange` of the counted pixels; the current range if none were counted.
    Span suggested(const ByteScale &scale, std::optional<double> threshold) const;
    /// Levels set by hand: at least ½ apart. For differences zero stays in the middle of the colours, so both ends move
    /// together.
    Span byHand(double low, double high, const ByteScale *scale) const;

private:
    Span m_range{-6.0, 14.0};
    bool m_isAutomatic = true;
    std::vector<double> m_histogram;
    std::pair<int, Index> m_key{-1, 0}; ///< level and cells per pixel of the last count
};

} // namespace faintline
