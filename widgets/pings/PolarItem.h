#pragma once

#include "base/Axis.h"
#include "frames/PeakPyramid.h"
#include "widgets/base/Span.h"
#include "widgets/plot/ColourMap.h"

#include <qwt_plot_item.h>

#include <QColor>

#include <memory>
#include <optional>

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
    void setColours(const ColourMap &map, const Span &range, std::optional<double> threshold = {});
    /// Pixels adjacent to values at or above this one are drawn in the contour's colour.
    void setContour(std::optional<double> value, QRgb colour);
    void setGround(const QColor &ground) { m_ground = ground; } ///< where there are no cells

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

    QImage image(const Span &x, const Span &y, const QSize &size) const;

private:
    std::shared_ptr<const PeakPyramid> m_picture;
    Axis m_bearing;
    const ColourMap *m_map;
    Span m_range{-6.0, 14.0};
    std::optional<double> m_threshold; ///< of the colours
    std::optional<double> m_contour;
    QRgb m_contourColour = 0xffffffff;
    QColor m_ground;
};

} // namespace faintline
