// Colours of a WaterfallPicture: its map, and the values of the first and last colour.

#include "widgets/waterfall/WaterfallPicture.h"

#include "widgets/base/rasterise.h"
#include "widgets/waterfall/RasterItem.h"

#include <algorithm>
#include <utility>

namespace faintline {

void WaterfallPicture::countHistogram()
{
    const QSize size = canvas()->contentsRect().size();
    if (!m_picture || size.isEmpty() || m_frequency.count == 0)
        return;
    const double cells =
        visible().frequency.width() / m_frequency.step / (isTimeVertical() ? size.width() : size.height());
    if (!m_levels.count(*m_shown, framesPerPixel(), cells))
        return;
    emit histogramChanged();
    if (m_levels.isAutomatic())
        applyRange(automaticRange());
}

Span WaterfallPicture::automaticRange() const
{
    if (m_picture && m_isPlain && !histogram().empty())
        return rangeOfLevels(m_picture->scale(), histogram());
    return m_picture ? m_levels.suggested(m_picture->scale(), m_threshold) : range();
}

void WaterfallPicture::setPlain(bool isPlain)
{
    if (std::exchange(m_isPlain, isPlain) != isPlain)
        m_levels.setAutomatic(true);
}

void WaterfallPicture::applyRange(const Span &range)
{
    const bool isOther = range != m_levels.range();
    m_levels.setRange(range);
    m_raster->setColours(colours());
    if (isOther)
        emit rangeChanged(range.low, range.high);
}

void WaterfallPicture::setRange(double low, double high)
{
    m_levels.setAutomatic(false);
    applyRange(m_levels.byHand(low, high, m_picture ? &m_picture->scale() : nullptr));
    replot();
}

void WaterfallPicture::setAutomaticRange()
{
    m_levels.setAutomatic(true);
    applyRange(automaticRange());
    replot();
}

double WaterfallPicture::levelStep() const
{
    return valueUnit() == tr("dB") ? 1.0 : std::max(0.5, 0.01 * range().width());
}

void WaterfallPicture::stepBlack(int steps)
{
    const double step = levelStep();
    setRange(std::min(range().low + steps * step, range().high - step), range().high);
}

void WaterfallPicture::stepWhite(int steps)
{
    const double step = levelStep();
    setRange(range().low, std::max(range().high + steps * step, range().low + step));
}

PictureColours WaterfallPicture::colours() const
{
    return {&m_display->colourMap(), range(), m_threshold};
}

} // namespace faintline
