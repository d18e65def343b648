#pragma once

#include "analysis/analyse.h"
#include "recording/Truth.h"
#include "widgets/base/Theme.h"
#include "widgets/base/Viewport.h"
#include "widgets/waterfall/Sidebands.h"

#include <qwt_plot_item.h>

#include <QPolygonF>

#include <optional>
#include <vector>

namespace faintline {

/// What is drawn over a waterfall: truth, tracks, events, the measured box, harmonics and sidebands, the cursor.
///
/// Every line has a dark seam, so it can be seen on any colour of the map.
class OverlayItem : public QwtPlotItem
{
public:
    /// An event as a box with its number.
    struct Mark {
        int id = 0;
        Viewport::Box box;
        bool isConfirmed = true;
    };
    /// A box somebody drew.
    struct Box {
        Viewport::Box box;
        QString text;
        bool isFaint = false;
    };
    /// A polyline, x in seconds, y in Hz.
    struct Line {
        int id = 0;
        QPolygonF points;
        QPolygonF band{}; ///< 5 % of the posterior forth, 95 % back, where it is known
    };
    OverlayItem();

    Theme::Colours colours;
    bool isTimeVertical = true;
    std::vector<Mark> marks;
    std::vector<Line> tracks;
    std::vector<Line> truth;
    std::vector<Box> boxes;
    std::vector<Box> areas;       ///< of raised level, without a line
    std::vector<int> faintEvents; ///< rejected ones: there, but not in the way
    bool hasEvents = true, hasTracks = true, hasTruth = true;
    int selectedEvent = 0;
    std::optional<Viewport::Point> cursor;
    std::vector<double> harmonicsHz;
    std::optional<Sidebands> sidebands;
    QString sidebandText; ///< carrier, spacing and levels
    std::optional<Viewport::Box> selection;
    QString selectionText;
    std::optional<Viewport::Box> rubber; ///< while a box is dragged

    void draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
              const QRectF &canvasRect) const override;

    static std::vector<Line> linesOf(const std::vector<Track> &followed, const Axis &time, const Axis &frequency);
    static std::vector<Line> linesOf(const std::vector<TruthLine> &known);
    static std::vector<Box> boxesOf(const std::vector<AreaEvent> &areas);
    /// Boxes around the events' tracks where there are any, otherwise along their straight lines; at least a bin and a
    /// frame wide.
    static std::vector<Mark> marksOf(const std::vector<Event> &events, const std::vector<Line> &lines,
                                     double frameSeconds, double binHz);

    /// Where a box lies on the canvas.
    static QRectF rectOf(const Viewport::Box &box, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                         bool isTimeVertical);
    /// The frame drawn around an event: its box with some room, never too small to be hit.
    static QRectF frameOf(const QRectF &rect);

private:
    struct Canvas;

    void drawLines(const Canvas &canvas, const std::vector<Line> &lines, const QPen &pen) const;
    void drawSelectedBand(const Canvas &canvas) const;
    void drawEvents(const Canvas &canvas) const;
    enum class Labels { All, WhereTheyFit };
    void drawBoxes(const Canvas &canvas, const std::vector<Box> &some, const QPen &pen, Labels labels) const;
    bool isFaint(int event) const;
    void drawHarmonics(const Canvas &canvas) const;
    void drawSidebands(const Canvas &canvas) const;
    void drawCursor(const Canvas &canvas) const;
    void drawSelection(const Canvas &canvas) const;
};

} // namespace faintline
