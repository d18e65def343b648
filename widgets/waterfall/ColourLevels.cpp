#include "widgets/waterfall/ColourLevels.h"

#include "widgets/base/rasterise.h"

#include <algorithm>
#include <cmath>

namespace faintline {

bool ColourLevels::count(const PeakPyramid &picture, double framesPerPixel, double cellsPerPixel)
{
    const auto group = Index(std::exp2(std::round(std::log2(std::max(cellsPerPixel, 1.0)))));
    const std::pair key{picture.levelFor(std::max(framesPerPixel, 1.0)), group};
    if (key == m_key)
        return false;
    m_key = key;
    m_histogram = countPixels(picture, framesPerPixel, double(group));
    return true;
}

Span ColourLevels::suggested(const ByteScale &scale, std::optional<double> threshold) const
{
    return m_histogram.empty() ? m_range : automaticRange(scale, m_histogram, threshold);
}

Span ColourLevels::byHand(double low, double high, const ByteScale *scale) const
{
    constexpr double smallest = 0.5;
    if (scale && scale->kind() == ByteScale::Kind::DifferenceNats) {
        const double half = std::max(low != m_range.low ? -low : high, smallest);
        return {-half, half};
    }
    return {low, std::max(high, low + smallest)};
}

} // namespace faintline
