#include "widgets/waterfall/OverlayItem.h"

#include "widgets/base/textPlate.h"

#include <qwt_scale_map.h>

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    constexpr double faintOpacity = 0.3;
    constexpr std::size_t bracketLimit = 12; ///< more brackets and numbers would hide what they mark
    const QColor seam(0, 0, 0, 150);

    QPen linePen(const QColor &colour, double width, Qt::PenStyle style = Qt::SolidLine)
    {
        QPen pen(colour, width, style, Qt::FlatCap, Qt::RoundJoin);
        if (style == Qt::CustomDashLine || style == Qt::DashLine)
            pen.setDashPattern({5.0, 4.0});
        return pen;
    }

    /// Pen of a track: dashed while provisional, thick while it is followed.
    QPen penOf(TrackStage stage, QPen pen)
    {
        if (stage == TrackStage::Provisional)
            return linePen(pen.color(), 1.6, Qt::DashLine);
        if (stage == TrackStage::Confirmed)
            pen.setWidthF(2.2);
        return pen;
    }

    /// Four corners of a frame, which cover less of the picture than its sides.
    QList<QLineF> corners(const QRectF &rect)
    {
        const double x = std::min(7.0, 0.4 * rect.width()), y = std::min(7.0, 0.4 * rect.height());
        const QPointF a = rect.topLeft(), b = rect.topRight(), c = rect.bottomRight(), d = rect.bottomLeft();
        return {{a, a + QPointF(x, 0)}, {a, a + QPointF(0, y)}, {b, b - QPointF(x, 0)}, {b, b + QPointF(0, y)},
                {c, c - QPointF(x, 0)}, {c, c - QPointF(0, y)}, {d, d + QPointF(x, 0)}, {d, d - QPointF(0, y)}};
    }

} // namespace

/// Painter and scales.
struct OverlayItem::Canvas {
    QPainter &painter;
    const QwtScaleMap &x;
    const QwtScaleMap &y;
    QRectF rect;
    bool isTimeVertical;

    double time(double seconds) const { return isTimeVertical ? y.transform(seconds) : x.transform(seconds); }
    double frequency(double hz) const { return isTimeVertical ? x.transform(hz) : y.transform(hz); }
    Span visibleTime() const
    {
        const QwtScaleMap &map = isTimeVertical ? y : x;
        return {std::min(map.s1(), map.s2()), std::max(map.s1(), map.s2())};
    }
    QPointF point(double seconds, double hz) const
    {
        return isTimeVertical ? QPointF(frequency(hz), time(seconds)) : QPointF(time(seconds), frequency(hz));
    }
    QLineF across(double seconds) const
    {
        const double t = std::round(time(seconds)) + 0.5;
        return isTimeVertical ? QLineF(rect.left(), t, rect.right(), t) : QLineF(t, rect.top(), t, rect.bottom());
    }
    QLineF along(double hz) const
    {
        const double f = std::round(frequency(hz)) + 0.5;
        return isTimeVertical ? QLineF(f, rect.top(), f, rect.bottom()) : QLineF(rect.left(), f, rect.right(), f);
    }

    /// Draws a line with its outline.
    void stroke(const QList<QLineF> &lines, const QPen &pen) const
    {
        painter.setPen(QPen(seam, pen.widthF() + 2.0, Qt::SolidLine, Qt::SquareCap));
        painter.drawLines(lines);
        painter.setPen(pen);
        painter.drawLines(lines);
    }

    /// Plate of a label of one or more lines with this corner, kept within the canvas.
    QRectF plateOf(const QPointF &corner, const QString &text, const QFont &font = Theme::plotFont()) const
    {
        return faintline::plateOf(text, corner, rect, font);
    }

    /// Draws small text on a dark background.
    void label(const QPointF &corner, const QString &text, const QColor &colour,
               const QColor &plate = QColor(0, 0, 0, 205), const QFont &font = Theme::plotFont()) const
    {
        painter.setFont(font);
        const auto alignment = text.contains(QLatin1Char('\n')) ? Qt::AlignLeft : Qt::AlignCenter;
        drawOnPlate(painter, plateOf(corner, text, font), text, colour, plate, alignment);
    }
};

OverlayItem::OverlayItem() : colours(Theme::colours(Theme::Kind::Light))
{
    setZ(10.0);
}

QRectF OverlayItem::rectOf(const Viewport::Box &box, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                           bool isTimeVertical)
{
    const Span &x = isTimeVertical ? box.frequency : box.time;
    const Span &y = isTimeVertical ? box.time : box.frequency;
    return QRectF(QPointF(xMap.transform(x.low), yMap.transform(y.low)),
                  QPointF(xMap.transform(x.high), yMap.transform(y.high)))
        .normalized();
}

QRectF OverlayItem::frameOf(const QRectF &rect)
{
    constexpr double room = 4.0, smallest = 13.0;
    QRectF frame = rect.adjusted(-room, -room, room, room);
    const double x = std::max(smallest - frame.width(), 0.0) / 2.0, y = std::max(smallest - frame.height(), 0.0) / 2.0;
    return frame.adjusted(-x, -y, x, y);
}

void OverlayItem::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                       const QRectF &canvasRect) const
{
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    const Canvas canvas{*painter, xMap, yMap, canvasRect, isTimeVertical};
    if (hasTruth)
        drawLines(canvas, truth, linePen(colours.truth, 1.0, Qt::DashLine));
    if (hasTracks) {
        drawSelectedBand(canvas);
        drawLines(canvas, tracks, linePen(colours.track, 1.0));
    }
    drawTimes(canvas);
    if (hasEvents)
        drawBoxes(canvas, areas, linePen(colours.track, 1.0, Qt::DotLine), Labels::WhereTheyFit);
    drawBoxes(canvas, boxes, linePen(colours.cursor, 1.0), Labels::All);
    drawHarmonics(canvas);
    drawSidebands(canvas);
    drawCursor(canvas);
    drawCursorNote(canvas);
    drawSelection(canvas); // over the cursor, which would otherwise cross its figures
    if (hasEvents)
        drawEvents(canvas);
    painter->restore();
}

void OverlayItem::drawTimes(const Canvas &canvas) const
{
    for (const OverlayTime &time : times) {
        const QLineF line = canvas.across(time.seconds);
        if (!canvas.rect.contains(line.center()))
            continue;
        canvas.stroke({line}, linePen(colours.cursor, 1.0, Qt::DashLine));
        canvas.label(line.p1() + QPointF(4.0, 3.0), time.text, colours.cursor);
    }
}

void OverlayItem::drawLines(const Canvas &canvas, const std::vector<OverlayLine> &lines, const QPen &usual) const
{
    const Span visible = canvas.visibleTime();
    for (const OverlayLine &line : lines) {
        if (&lines == &tracks && areTracksPictured && line.id != selectedEvent)
            continue;
        const QPen pen = penOf(line.stage, usual);
        canvas.painter.setOpacity(isFaint(line.id) ? faintOpacity : 1.0);
        // The visible part with one more point at either end; one point per pixel is enough.
        const auto isBefore = [](const QPointF &point, double seconds) { return point.x() < seconds; };
        auto first = std::lower_bound(line.points.begin(), line.points.end(), visible.low, isBefore);
        auto last = std::lower_bound(first, line.points.end(), visible.high, isBefore);
        if (first != line.points.begin())
            --first;
        if (last != line.points.end())
            ++last;
        QPolygonF polygon;
        for (auto point = first; point != last; ++point) {
            const QPointF position = canvas.point(point->x(), point->y());
            if (polygon.isEmpty() || point + 1 == last || (position - polygon.back()).manhattanLength() >= 2.5)
                polygon << position;
        }
        if (!polygon.boundingRect().adjusted(-4, -4, 4, 4).intersects(canvas.rect))
            continue;
        canvas.painter.setPen(QPen(seam, pen.widthF() + 1.6, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
        canvas.painter.drawPolyline(polygon);
        canvas.painter.setPen(pen);
        canvas.painter.drawPolyline(polygon);
    }
    canvas.painter.setOpacity(1.0);
}

void OverlayItem::drawSelectedBand(const Canvas &canvas) const
{
    QColor colour = colours.selectedEvent;
    colour.setAlpha(90);
    canvas.painter.setPen(Qt::NoPen);
    canvas.painter.setBrush(colour);
    for (const OverlayLine &line : tracks) {
        if (selectedEvent == 0 || line.id != selectedEvent)
            continue;
        QPolygonF ribbon;
        for (const QPointF &point : line.band)
            if (const QPointF position = canvas.point(point.x(), point.y());
                ribbon.isEmpty() || (position - ribbon.back()).manhattanLength() >= 1.0)
                ribbon << position;
        canvas.painter.drawPolygon(ribbon);
    }
    canvas.painter.setBrush(Qt::NoBrush);
}

bool OverlayItem::isFaint(int event) const
{
    return event != 0 && event != selectedEvent
           && std::find(faintEvents.begin(), faintEvents.end(), event) != faintEvents.end();
}

void OverlayItem::drawBoxes(const Canvas &canvas, const std::vector<OverlayBox> &some, const QPen &pen,
                            Labels labels) const
{
    for (const OverlayBox &box : some) {
        const QRectF rect =
            rectOf(box.box, canvas.x, canvas.y, isTimeVertical).intersected(canvas.rect.adjusted(-9, -9, 9, 9));
        if (!rect.isValid())
            continue;
        canvas.painter.setOpacity(box.isFaint ? faintOpacity : 1.0);
        canvas.stroke({{rect.topLeft(), rect.topRight()},
                       {rect.topRight(), rect.bottomRight()},
                       {rect.bottomRight(), rect.bottomLeft()},
                       {rect.bottomLeft(), rect.topLeft()}},
                      pen);
        const QSizeF size = QFontMetricsF(canvas.painter.font()).size(0, box.text);
        const bool fits = size.width() < rect.width() && size.height() < rect.height();
        if (!box.text.isEmpty() && (labels == Labels::All || fits))
            canvas.label(rect.topLeft() + QPointF(2.0, 2.0), box.text, pen.color());
    }
    canvas.painter.setOpacity(1.0);
}

void OverlayItem::drawEvents(const Canvas &canvas) const
{
    // Of many events only the selected one and the one under the pointer have brackets; the others have their tracks.
    const auto rectOfMark = [&](const OverlayMark &mark) {
        return frameOf(rectOf(mark.box, canvas.x, canvas.y, isTimeVertical));
    };
    const auto inSight = std::size_t(std::count_if(
        marks.begin(), marks.end(), [&](const OverlayMark &mark) { return rectOfMark(mark).intersects(canvas.rect); }));
    const bool areMany = inSight > bracketLimit;
    const auto isNamed = [&](const OverlayMark &mark) {
        return !areMany || mark.id == selectedEvent || mark.id == hoveredEvent;
    };
    const auto colourOf = [&](const OverlayMark &mark) {
        QColor colour = mark.id == selectedEvent ? colours.selectedEvent : colours.event;
        if (!mark.isConfirmed && mark.id != selectedEvent)
            colour.setAlpha(150);
        return colour;
    };
    std::vector<QRectF> brackets, numbers;
    std::vector<const OverlayMark *> named; ///< the selected one first
    for (const OverlayMark &mark : marks) {
        const QRectF rect = rectOfMark(mark);
        if (!rect.intersects(canvas.rect) || (hasTracks && !isNamed(mark)))
            continue;
        const bool isSelected = mark.id == selectedEvent;
        canvas.painter.setOpacity(isFaint(mark.id) ? faintOpacity : 1.0);
        canvas.stroke(corners(rect), linePen(colourOf(mark), isSelected ? 2.0 : 1.4));
        for (const QLineF &line : corners(rect))
            brackets.push_back(QRectF(line.p1(), line.p2()).normalized().adjusted(-1.0, -1.0, 1.0, 1.0));
        if (isNamed(mark))
            named.insert(isSelected ? named.begin() : named.end(), &mark);
    }
    // At one of the frame's corners where no other number is, and if possible no bracket; nothing if there is none.
    const auto roomFor = [&](const QRectF &frame, const QString &number) -> std::optional<QPointF> {
        constexpr double gap = 3.0;
        const QSizeF size = canvas.plateOf({}, number).size();
        const double top = std::max(frame.top() - 1.0, canvas.rect.top() + 2.0);
        const double bottom = frame.bottom() + 1.0 - size.height();
        const double left = frame.left() - gap - size.width();
        for (const bool isOverBrackets : {false, true})
            for (const QPointF &corner : {QPointF(frame.right() + gap, top), QPointF(left, top),
                                          QPointF(frame.right() + gap, bottom), QPointF(left, bottom)}) {
                const QRectF plate = canvas.plateOf(corner, number);
                const auto isOver = [&plate](const QRectF &other) { return other.intersects(plate); };
                if (std::ranges::any_of(numbers, isOver) || (!isOverBrackets && std::ranges::any_of(brackets, isOver)))
                    continue;
                numbers.push_back(plate);
                return corner;
            }
        return {};
    };
    for (const OverlayMark *mark : named) {
        const QString number =
            mark->stage == TrackStage::Provisional ? QStringLiteral("%1?").arg(mark->id) : QString::number(mark->id);
        canvas.painter.setOpacity(isFaint(mark->id) ? faintOpacity : 1.0);
        const std::optional<QPointF> corner = roomFor(rectOfMark(*mark), number);
        if (corner && mark->id == selectedEvent)
            canvas.label(*corner, number, QColor(0x10141a), colours.selectedEvent);
        else if (corner)
            canvas.label(*corner, number, colourOf(*mark));
    }
    canvas.painter.setOpacity(1.0);
}

void OverlayItem::drawHarmonics(const Canvas &canvas) const
{
    for (std::size_t i = 0; i < harmonicsHz.size(); ++i) {
        const QLineF line = canvas.along(harmonicsHz[i]);
        if (!canvas.rect.contains(line.center()))
            continue;
        canvas.stroke({line}, linePen(colours.cursor, 1.0, Qt::DashLine));
        canvas.label(line.p1() + QPointF(4.0, 4.0), QString::number(i + 1) + QStringLiteral("×"), colours.cursor);
    }
}

void OverlayItem::drawSidebands(const Canvas &canvas) const
{
    if (!sidebands)
        return;
    constexpr double roomForNames = 22.0;
    const double first = canvas.frequency(sidebands->hz(0)), second = canvas.frequency(sidebands->hz(1));
    for (int order = -Sidebands::orders; order <= Sidebands::orders; ++order) {
        const QLineF line = canvas.along(sidebands->hz(order));
        if (!canvas.rect.contains(line.center()))
            continue;
        canvas.stroke({line}, linePen(colours.cursor, 1.0, order == 0 ? Qt::SolidLine : Qt::DotLine));
        const bool isNamed = std::abs(second - first) >= roomForNames || order == 0;
        const QString name = order == 0  ? QStringLiteral("0")
                             : order > 0 ? QStringLiteral("+%1").arg(order)
                                         : QStringLiteral("−%1").arg(-order);
        if (isNamed)
            canvas.label(line.p1() + QPointF(4.0, 4.0), name, colours.cursor);
    }
    canvas.label(canvas.rect.bottomLeft() + QPointF(6.0, -6.0), sidebandText, colours.cursor, QColor(0, 0, 0, 190),
                 Theme::monoFont(Theme::plotFont().pixelSize()));
}

void OverlayItem::drawCursor(const Canvas &canvas) const
{
    if (!cursor)
        return;
    QColor colour = colours.cursor;
    colour.setAlpha(210);
    // The crossing itself is left free, because it is the cell of interest.
    constexpr double gap = 9.0;
    const QLineF across = canvas.across(cursor->seconds), along = canvas.along(cursor->hz);
    const QPointF centre = isTimeVertical ? QPointF(along.x1(), across.y1()) : QPointF(across.x1(), along.y1());
    canvas.stroke({{canvas.rect.left(), centre.y(), centre.x() - gap, centre.y()},
                   {centre.x() + gap, centre.y(), canvas.rect.right(), centre.y()},
                   {centre.x(), canvas.rect.top(), centre.x(), centre.y() - gap},
                   {centre.x(), centre.y() + gap, centre.x(), canvas.rect.bottom()}},
                  linePen(colour, 1.0));
}

/// In the corner that is not used by the sidebands.
void OverlayItem::drawCursorNote(const Canvas &canvas) const
{
    if (cursor && !cursorNote.isEmpty())
        canvas.label(canvas.rect.bottomRight() + QPointF(-6.0, -6.0), cursorNote, colours.cursor, QColor(0, 0, 0, 190),
                     Theme::monoFont(Theme::plotFont().pixelSize()));
}

void OverlayItem::drawSelection(const Canvas &canvas) const
{
    const auto drawBox = [&](const Viewport::Box &box) {
        const QRectF rect = rectOf(box, canvas.x, canvas.y, isTimeVertical);
        QColor fill = colours.cursor;
        fill.setAlpha(36);
        canvas.painter.fillRect(rect, fill);
        canvas.stroke({{rect.topLeft(), rect.topRight()},
                       {rect.topRight(), rect.bottomRight()},
                       {rect.bottomRight(), rect.bottomLeft()},
                       {rect.bottomLeft(), rect.topLeft()}},
                      linePen(colours.cursor, 1.0, Qt::DashLine));
        return rect;
    };
    if (selection) {
        const QRectF rect = drawBox(*selection);
        if (rect.intersects(canvas.rect))
            canvas.label(rect.bottomLeft() + QPointF(0.0, 4.0), selectionText, colours.cursor, QColor(0, 0, 0));
    }
    if (rubber)
        drawBox(*rubber);
}

} // namespace faintline
