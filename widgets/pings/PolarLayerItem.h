#pragma once

#include "widgets/waterfall/LayerItem.h"

#include <qwt_plot_item.h>

namespace faintline {

/// The layer of a ping shown by a LayerItem, seen from above.
class PolarLayerItem : public QwtPlotItem
{
public:
    /// `layer` must outlive this item.
    explicit PolarLayerItem(const LayerItem &layer);

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

private:
    const LayerItem &m_layer;
};

} // namespace faintline
