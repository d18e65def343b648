#pragma once

#include "base/Axis.h"
#include "frames/PeakPyramid.h"
#include "widgets/base/Span.h"
#include "widgets/plot/PictureColours.h"

#include <qwt_plot_item.h>

#include <QColor>

#include <memory>

namespace faintline {

/// A picture of range × bearing seen from above: north up, bearings clockwise, x = r sin b, y = r cos b, in the unit of
/// the range.
///
/// Along a bearing every pixel holds the maximum of its ranges (`rasterise`), so no cell is lost. Cost: one lookup per
/// pixel, some 10 ms for a million.
class PolarItem : public QwtPlotItem
{
public:
    PolarItem();

    /// `range` is the picture's own axis, `bearing` that of its cells, in degrees.
    void setPicture(std::shared_ptr<const PeakPyramid> picture, const Axis &bearing);
    void setColours(const PictureColours &colours) { m_colours = colours; }
    void setGround(const QColor &ground) { m_ground = ground; } ///< where there are no cells

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

    QImage image(const Span &x, const Span &y, const QSize &size) const;

private:
    std::shared_ptr<const PeakPyramid> m_picture;
    Axis m_bearing;
    PictureColours m_colours;
    QColor m_ground;
};

} // namespace faintline
