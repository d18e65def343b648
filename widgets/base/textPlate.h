#pragma once

#include "widgets/base/Theme.h"

#include <QFont>
#include <QRectF>
#include <QString>

class QPainter;

namespace faintline {

/// Small text on a plate, over pictures and curves.

/// The box, moved into the canvas by as little as possible.
QRectF movedInto(QRectF box, const QRectF &canvas);

/// Plate of a text of one or more lines with this corner, kept within the canvas.
QRectF plateOf(const QString &text, const QPointF &corner, const QRectF &canvas, const QFont &font = Theme::plotFont());

/// Draws a text in the painter's font in the middle of its plate, or its lines from the left edge.
void drawOnPlate(QPainter &painter, const QRectF &plate, const QString &text, const QColor &colour,
                 const QColor &ground, Qt::Alignment alignment = Qt::AlignCenter);

} // namespace faintline
