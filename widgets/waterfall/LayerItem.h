#pragma once

#include "inspect/outputLayers.h"
#include "widgets/base/Span.h"

#include <qwt_plot_item.h>

#include <QColor>
#include <QImage>

#include <memory>

class QPainter;

namespace faintline {

class ColourMap;

/// Draws a layer of the detector's output on a waterfall or the map of a ping, instead of the statistic or over it, and
/// its key in a corner.
///
/// Rates use a diverging map about 0, with grey where all states were reset and no rate has won; ages and reset
/// fractions use a sequential one, inhibited cells a colour of their own. Presence is drawn in the picture's colours if
/// it replaces the statistic, otherwise in those of ages. Over the statistic, the opacity of a layer
/// follows the height of the statistic above the noise, or its own value, so that only relevant parts are visible.
class LayerItem : public QwtPlotItem
{
public:
    LayerItem();

    /// `rows` and `columns`: the analysis's own axes, time and frequency or a ping's range and bearing. Null: nothing
    /// is drawn.
    void setPicture(std::shared_ptr<const LayerPicture> picture, const Axis &rows, const Axis &columns);
    const std::shared_ptr<const LayerPicture> &picture() const { return m_picture; }
    bool isShown() const
    {
        return m_picture && m_layer != OutputLayer::Statistic && m_picture->rows > 0 && m_picture->columns > 0;
    }
    const Axis &rows() const { return m_rows; }
    const Axis &columns() const { return m_columns; }
    const QImage &image() const; ///< columns × rows of the picture, premultiplied

    /// `range`: values at the ends of the colours; `title`: their name with unit; `divisor`: size of that unit.
    void setLayer(OutputLayer layer, const Span &range, const QString &title, double divisor);
    OutputLayer layer() const { return m_layer; }
    const Span &range() const { return m_range; }
    const QString &title() const { return m_title; }

    /// Over the statistic: transparent at 0 nat, opaque at `opaqueNats`.
    void setOverlay(bool isOverlay, double opaqueNats);
    bool isOverlay() const { return m_isOverlay; }

    void setTimeVertical(bool isVertical) { m_isTimeVertical = isVertical; }
    /// Of the key, and the picture's map.
    void setColours(const QColor &text, const QColor &plate, const ColourMap &map);

    /// The key, a separate item drawn over all marks; it must not outlive this one.
    std::unique_ptr<QwtPlotItem> makeKey() const;

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

private:
    class Key;
    const ColourMap &map() const;
    QRgb colourOf(std::size_t pixel) const;
    QImage imageAlong(const QwtScaleMap &hz, const Span &pixels) const;
    void drawKey(QPainter *painter, const QRectF &canvas) const;

    std::shared_ptr<const LayerPicture> m_picture;
    Axis m_rows;
    Axis m_columns;
    OutputLayer m_layer = OutputLayer::Statistic;
    Span m_range{0.0, 1.0};
    QString m_title;
    double m_divisor = 1.0;
    bool m_isOverlay = false;
    double m_opaqueNats = 10.0;
    bool m_isTimeVertical = true;
    QColor m_text;
    QColor m_plate;
    const ColourMap *m_pictureMap;
    mutable QImage m_image; ///< columns × rows; null: not created yet
};

} // namespace faintline
