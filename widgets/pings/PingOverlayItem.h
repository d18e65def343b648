#pragma once

#include "widgets/base/Theme.h"
#include "widgets/pings/PingMarks.h"

#include <qwt_plot_item.h>

#include <functional>

namespace faintline {

/// Draws the marks of a ping over its map: truth, tracks with their tails, detections, inhibited boxes, the cursor. The
/// map supplies the canvas position of a place, so that one item serves both the plane and the polar map.
class PingOverlayItem : public QwtPlotItem
{
public:
    /// Pixel of a place (range, bearing).
    using PlaceOnCanvas =
        std::function<QPointF(const PingMarks::Place &place, const QwtScaleMap &x, const QwtScaleMap &y)>;

    explicit PingOverlayItem(PlaceOnCanvas place);

    PingMarks marks;
    Theme::Colours colours;
    /// Period of the bearing axis if its ends are apart on the canvas, so that lines across them are cut; 0: they are
    /// not.
    double turn = 0.0;
    bool hasTracks = true;
    bool hasTruth = true;
    bool hasBoxes = true;
    bool hasConventional = false;
    bool hasEvents = true;
    int selectedTrack = 0;
    std::vector<int> faintTracks;           ///< rejected ones, drawn faintly
    std::optional<PingMarks::Place> cursor; ///< drawn as a small cross

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

private:
    struct Canvas;
    enum class Head { Circle, Square, Diamond };

    bool isFaint(int track) const;
    void drawBoxes(const Canvas &canvas) const;
    void drawTrail(const Canvas &canvas, const PingMarks::Trail &trail, const QColor &colour, Head head) const;
    void drawDetections(const Canvas &canvas) const;
    void drawCursor(const Canvas &canvas) const;

    PlaceOnCanvas m_place;
};

} // namespace faintline
