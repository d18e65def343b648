#pragma once

#include "widgets/base/Theme.h"
#include "widgets/base/Viewport.h"
#include "widgets/waterfall/Sidebands.h"
#include "widgets/waterfall/overlayMarks.h"

#include <qwt_plot_item.h>

#include <optional>
#include <vector>

namespace faintline {

/// Draws marks over a waterfall: truth, tracks, events, the measured box, harmonics and sidebands, the cursor.
///
/// Every line has a dark outline, so that it is visible on any colour of the map.
class OverlayItem : public QwtPlotItem
{
public:
    OverlayItem();

    Theme::Colours colours;
    bool isTimeVertical = true;
    std::vector<OverlayMark> marks;
    std::vector<OverlayLine> tracks;
    std::vector<OverlayLine> truth;
    std::vector<OverlayBox> boxes;
    std::vector<OverlayTime> times;
    std::vector<OverlayBox> areas; ///< of raised level, without a line
    std::vector<int> faintEvents;  ///< rejected ones, drawn faintly
    bool hasEvents = true, hasTracks = true, hasTruth = true;
    bool areTracksPictured = false; ///< by the picture: only the selected one is drawn over it
    int selectedEvent = 0;
    int hoveredEvent = 0; ///< under the pointer; 0: none
    std::optional<Viewport::Point> cursor;
    std::vector<double> harmonicsHz;
    std::optional<Sidebands> sidebands;
    QString sidebandText; ///< carrier, spacing and levels
    QString cursorNote;   ///< additional text for the cursor
    std::optional<Viewport::Box> selection;
    QString selectionText;
    std::optional<Viewport::Box> rubber; ///< while a box is dragged

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

    /// Position of a box on the canvas.
    static QRectF rectOf(const Viewport::Box &box, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                         bool isTimeVertical);
    /// The frame drawn around an event: its box with a margin, never too small to be clicked.
    static QRectF frameOf(const QRectF &rect);

private:
    struct Canvas;

    void drawLines(const Canvas &canvas, const std::vector<OverlayLine> &lines, const QPen &pen) const;
    void drawTimes(const Canvas &canvas) const;
    void drawSelectedBand(const Canvas &canvas) const;
    void drawEvents(const Canvas &canvas) const;
    enum class Labels { All, WhereTheyFit };
    void drawBoxes(const Canvas &canvas, const std::vector<OverlayBox> &some, const QPen &pen, Labels labels) const;
    bool isFaint(int event) const;
    void drawHarmonics(const Canvas &canvas) const;
    void drawSidebands(const Canvas &canvas) const;
    void drawCursor(const Canvas &canvas) const;
    void drawCursorNote(const Canvas &canvas) const;
    void drawSelection(const Canvas &canvas) const;
};

} // namespace faintline
