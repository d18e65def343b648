#pragma once

#include "widgets/base/ThemedPlot.h"
#include "widgets/pings/PingMarks.h"
#include "widgets/waterfall/WaterfallView.h"

namespace faintline {

class PingOverlayItem;
class PolarItem;

/// A map of range × bearing from above, north up: another view of a WaterfallView's picture. It follows that view's
/// viewport, colours, contour and layers, and forwards key events to it.
///
/// Mouse: Ctrl+wheel zooms about the pointer, click places the cursor. A sector wider than half a turn is shown as a
/// full circle.
class PolarView : public ThemedPlot
{
    Q_OBJECT

public:
    explicit PolarView(WaterfallView &view, QWidget *parent = nullptr);
    ~PolarView() override;

    /// Call after the view has a new picture.
    void followPicture();
    PingOverlayItem &overlay() { return *m_overlay; }

    /// Pixel on the canvas ↔ range and bearing.
    PingMarks::Place placeAt(const QPointF &canvasPosition) const;
    QPointF positionOf(const PingMarks::Place &place) const;

    QSize sizeHint() const override { return {420, 420}; }
    QSize minimumSizeHint() const override { return {110, 100}; }

signals:
    void hovered(double range, double bearing);
    void hoverEnded();

protected:
    void wheelEvent(QWheelEvent *event) override;
    void keyPressEvent(QKeyEvent *event) override;
    void contextMenuEvent(QContextMenuEvent *event) override;
    bool eventFilter(QObject *watched, QEvent *event) override;
    void restyle() override;
    void followCanvas() override { followSpan(); }

private:
    class GridItem;

    void followColours();
    void followSpan();

    WaterfallView &m_view;
    PolarItem *m_raster;
    GridItem *m_grid;
    PingOverlayItem *m_overlay;
};

} // namespace faintline
