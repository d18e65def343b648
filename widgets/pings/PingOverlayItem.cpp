#include "widgets/pings/PingOverlayItem.h"

#include "widgets/base/textPlate.h"

#include <qwt_scale_map.h>

#include <QFontMetricsF>
#include <QPainter>

#include <algorithm>
#include <cmath>

namespace faintline {

namespace {

    const QColor seam(0, 0, 0, 150);
    constexpr double faintOpacity = 0.3;

    void stroke(QPainter &painter, const QPolygonF &line, const QPen &pen)
    {
        painter.setPen(QPen(seam, pen.widthF() + 2.0, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin));
        painter.drawPolyline(line);
        painter.setPen(pen);
        painter.drawPolyline(line);
    }

} // namespace

struct PingOverlayItem::Canvas {
    QPainter &painter;
    const QwtScaleMap &x;
    const QwtScaleMap &y;
    QRectF rect;
    const PingOverlayItem &item;

    QPointF at(const PingMarks::Place &place) const { return item.m_place(place, x, y); }

    /// Small text on a dark background beside a point, kept within the canvas.
    void label(const QPointF &beside, const QString &text, const QColor &colour) const
    {
        painter.setFont(Theme::plotFont());
        const QPointF corner = beside + QPointF(7.0, -7.0 - QFontMetricsF(painter.font()).height());
        drawOnPlate(painter, plateOf(text, corner, rect), text, colour, QColor(0, 0, 0, 165));
    }
};

PingOverlayItem::PingOverlayItem(PlaceOnCanvas place)
    : colours(Theme::colours(Theme::Kind::Light)), m_place(std::move(place))
{
    setZ(12.0);
}

void PingOverlayItem::draw(QPainter *painter, const QwtScaleMap &xMap, const QwtScaleMap &yMap,
                           const QRectF &canvasRect) const
{
    painter->save();
    painter->setRenderHint(QPainter::Antialiasing);
    painter->setClipRect(canvasRect);
    const Canvas canvas{*painter, xMap, yMap, canvasRect, *this};
    if (hasBoxes)
        drawBoxes(canvas);
    if (hasTruth)
        for (const PingMarks::Trail &trail : marks.truth)
            drawTrail(canvas, trail, colours.truth, Head::Circle);
    if (hasConventional)
        for (const PingMarks::Trail &trail : marks.conventional)
            drawTrail(canvas, trail, colours.curves[1], Head::Diamond);
    if (hasTracks)
        for (const PingMarks::Trail &trail : marks.tracks) {
            painter->setOpacity(isFaint(trail.id) ? faintOpacity : 1.0);
            drawTrail(canvas, trail, trail.id == selectedTrack ? colours.selectedEvent : colours.track, Head::Square);
        }
    painter->setOpacity(1.0);
    if (hasEvents)
        drawDetections(canvas);
    drawCursor(canvas);
    painter->restore();
}

bool PingOverlayItem::isFaint(int track) const
{
    return track != selectedTrack && std::find(faintTracks.begin(), faintTracks.end(), track) != faintTracks.end();
}

void PingOverlayItem::drawBoxes(const Canvas &canvas) const
{
    // On a polar map a box is a sector of a ring: its sides are drawn in steps.
    constexpr int steps = 8;
    const auto between = [](const Span &span, int i) { return span.low + span.width() * i / steps; };
    canvas.painter.setBrush(QColor(255, 255, 255, 26));
    for (const PingMarks::Box &box : marks.boxes) {
        QPolygonF outline;
        for (int i = 0; i <= steps; ++i)
            outline << canvas.at({box.along.low, between(box.across, i)});
        for (int i = steps; i >= 0; --i)
            outline << canvas.at({box.along.high, between(box.across, i)});
        canvas.painter.setPen(QPen(QColor(255, 255, 255, 150), 1.0, Qt::DotLine));
        canvas.painter.drawPolygon(outline);
    }
    canvas.painter.setBrush(Qt::NoBrush);
}

void PingOverlayItem::drawTrail(const Canvas &canvas, const PingMarks::Trail &trail, const QColor &colour,
                                Head head) const
{
    QPolygonF line;
    const auto draw = [&] {
        QPen pen(colour, head == Head::Circle ? 1.0 : 1.6, Qt::SolidLine, Qt::FlatCap, Qt::RoundJoin);
        if (!trail.isDetected)
            pen.setDashPattern({2.0, 2.0});
        if (line.size() > 1)
            stroke(canvas.painter, line, pen);
        line.clear();
    };
    for (std::size_t i = 0; i < trail.places.size(); ++i) {
        if (i > 0 && turn > 0.0 && 2.0 * std::abs(trail.places[i].across - trail.places[i - 1].across) > turn)
            draw();
        line << canvas.at(trail.places[i]);
    }
    const QPointF at = line.back();
    draw();

    QPainter &painter = canvas.painter;
    for (const QPen &pen : {QPen(seam, 3.5), QPen(colour, 1.5)}) {
        painter.setPen(pen);
        if (head == Head::Circle)
            painter.drawEllipse(at, 6.0, 6.0);
        else if (head == Head::Square)
            painter.drawRect(QRectF(at - QPointF(4.0, 4.0), QSizeF(8.0, 8.0)));
        else
            painter.drawPolygon(QPolygonF{at + QPointF(0.0, -7.0), at + QPointF(7.0, 0.0), at + QPointF(0.0, 7.0),
                                          at + QPointF(-7.0, 0.0)});
    }
    if (head == Head::Square)
        canvas.label(at, QString::number(trail.id) + (trail.isConfirmed ? QString() : QStringLiteral("?")), colour);
}

void PingOverlayItem::drawDetections(const Canvas &canvas) const
{
    for (const PingMarks::Detection &detection : marks.detections) {
        const QPointF at = canvas.at(detection.place);
        canvas.painter.setOpacity(isFaint(detection.id) ? faintOpacity : 1.0);
        for (const QPen &pen : {QPen(seam, 4.0), QPen(colours.event, 2.0)}) {
            canvas.painter.setPen(pen);
            canvas.painter.drawEllipse(at, 12.0, 12.0);
        }
    }
    canvas.painter.setOpacity(1.0);
}

void PingOverlayItem::drawCursor(const Canvas &canvas) const
{
    if (!cursor)
        return;
    const QPointF at = canvas.at(*cursor);
    for (const QPen &pen : {QPen(seam, 3.0), QPen(colours.cursor, 1.0)}) {
        canvas.painter.setPen(pen);
        for (const QPointF &way : {QPointF(1.0, 0.0), QPointF(-1.0, 0.0), QPointF(0.0, 1.0), QPointF(0.0, -1.0)})
            canvas.painter.drawLine(at + 5.0 * way, at + 14.0 * way);
    }
}

} // namespace faintline
